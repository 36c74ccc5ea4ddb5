"""The command with which a run goes on, for messages."""

import pathlib
import shlex


def command(directory, shear_time=None):
    """Goes on from the last checkpoint; where there is none (cases/run removes those of finished runs), runs the same case anew."""
    folder, until = shlex.quote(str(directory)), "" if shear_time is None else f" --shear-time {shear_time:g}"
    if any(pathlib.Path(directory).glob("checkpoints/step_*")):
        return f"tanktread run --resume {folder}{until}"
    return f"tanktread run {shlex.quote(str(pathlib.Path(directory) / 'echo.toml'))} --output {folder} --force{until}"
