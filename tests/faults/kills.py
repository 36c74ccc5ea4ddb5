"""Runs that are killed, go on, are killed again ... and must end as the run that nothing disturbed."""

import collections
import dataclasses
import shutil
import time

import moments
import run_folder
import two_capsules


@dataclasses.dataclass
class Kill:
    """A SIGKILL that struck."""

    variant: str
    during: str  # "run" or "resume"
    met: str  # what the moment met


@dataclasses.dataclass
class Chain:
    """A run to its end, with the kills on the way."""

    kills: list = dataclasses.field(default_factory=list)
    faults: list = dataclasses.field(default_factory=list)  # lines; none: the whole run, bit for bit
    n_resumed: int = 0
    n_begun_anew: int = 0
    ended: bool = False


class Campaign:
    """Kills of runs in a folder."""

    def __init__(self, program):
        self.program = program
        self.wholes, self.seconds = {}, {}
        self.n_folders = 0

    def whole(self, variant):
        """The contents of the folder of a run that nothing disturbs."""
        name = self.name_of_whole(variant)
        if name not in self.wholes:
            start = time.monotonic()
            by_itself = variant if variant.name == name else two_capsules.PLAIN
            ended = self.program.do(self.program.run(by_itself, self.whole_folder(variant)))
            if ended.code != 0:
                raise RuntimeError(f"the run that nothing disturbs ended with {ended.code}: {ended.error}")
            self.seconds[name] = time.monotonic() - start
            self.wholes[name] = run_folder.contents(self.whole_folder(variant))
        return self.wholes[name]

    def name_of_whole(self, variant):
        """A record beside a run changes nothing in its folder, nor does what was there before, nor an end on the way."""
        return two_capsules.PLAIN.name if variant.records or variant.replaces or variant.extends else variant.name

    def whole_folder(self, variant):
        """Where that run is."""
        return self.program.folder / f"whole_{self.name_of_whole(variant).strip('-').replace(' ', '_')}"

    def chain(self, variant, chosen):
        """A run that is killed at each of the chosen moments in turn (the later ones during a resume), then goes on to its end."""
        chain, whole = Chain(), self.whole(variant)
        self.n_folders += 1
        output = self.program.folder / f"killed_{self.n_folders}"
        self._prepare(variant, output, chain)
        for moment in chosen:
            if not self._kill(moment, variant, output, chain):
                break
        if not chain.ended and not chain.faults:
            self._to_the_end(variant, output, chain)
        if chain.ended:
            chain.faults += run_folder.differences(whole, run_folder.contents(output))
            self._compare(variant, output, chain)
        if not chain.faults:
            shutil.rmtree(output)
        else:
            chain.faults.insert(0, f"{output} (kept): {'; '.join(f'{kill.during}, {kill.met}' for kill in chain.kills)}")
        return chain

    def _prepare(self, variant, output, chain):
        """What is there before the first command that is killed."""
        if variant.replaces:
            self.whole(two_capsules.CORRECTED)
            shutil.copytree(self.whole_folder(two_capsules.CORRECTED), output)
        if variant.extends:
            ended = self.program.do(self.program.run(variant, output, *self.program.time(self.program.n_steps // 2 + 1)))
            if ended.code != 0:
                chain.faults.append(f"half the run: exit code {ended.code}: {ended.error}")

    def _kill(self, moment, variant, output, chain):
        """The next command, killed at a moment; whether the kill struck."""
        arguments, during = self._next_command(variant, output, chain)
        process = self.program.start(arguments)
        met = moment.wait(process, output)
        process.kill()
        ended = self.program.end(process)
        if ended.code != -9:
            self._note_end(arguments, ended, chain)
            return False
        chain.kills.append(Kill(variant.name, during, met or "at the end"))
        if not variant.replaces and not variant.extends:
            chain.faults += run_folder.faults_a_reader_meets(output, self.whole(variant))
        return not chain.faults

    def _note_end(self, arguments, ended, chain):
        chain.ended = ended.code == 0
        if not chain.ended:
            chain.faults.append(f"{' '.join(map(str, arguments))}: exit code {ended.code}: {ended.error}")

    def _next_command(self, variant, output, chain):
        """What a user does with a folder: go on; where nothing can go on, start anew as the refusal says."""
        if not chain.kills and not variant.extends:
            return self.program.run(variant, output, *(["--force"] if variant.replaces else [])), "run"
        if variant.replaces:  # whoever said --force says it again
            return self.program.run(variant, output, *(["--force"] if (output / "echo.toml").exists() else [])), "run"
        if any(output.glob("checkpoints/step_*")):
            return self.program.resume(variant, output), "resume"
        chain.n_begun_anew += 1
        refused = self.program.do(self.program.resume(variant, output))
        if refused.code != 2:
            chain.faults.append(f"--resume without a checkpoint: exit code {refused.code}: {refused.error}")
        force = ["--force"] if (output / "echo.toml").exists() else []
        return self.program.run(variant, output, *force), "run"

    def _to_the_end(self, variant, output, chain):
        arguments, during = self._next_command(variant, output, chain)
        chain.n_resumed += during == "resume"
        self._note_end(arguments, self.program.do(arguments), chain)

    def _compare(self, variant, output, chain):
        """The program's own comparison says so too."""
        said = self.program.do(["diff", self.whole_folder(variant), output])
        if said.code != 0:
            chain.faults.append(f"tanktread diff: exit code {said.code}: {said.output}{said.error}")

    def two_in_one_folder(self):
        """A run beside which others are started in its folder: they are refused, and it ends as if nothing had been. Faults."""
        output, variant = self.program.folder / "shared", two_capsules.PLAIN
        process = self.program.start(self.program.run(variant, output))
        moments.AfterStep(self.program.n_steps // 6).wait(process, output)
        others = [
            self.program.do(self.program.resume(variant, output)),
            self.program.do(self.program.run(variant, output, "--force")),
        ]
        at_work = process.poll() is None
        ended = self.program.end(process)
        faults = [] if at_work else ["the run was at its end before the others were: nothing was tried"]
        faults += [] if ended.code == 0 else [f"the first: exit code {ended.code}: {ended.error}"]
        for other in others:
            if other.code != 2 or "another tanktread process" not in other.error:
                faults.append(f"the second: exit code {other.code}: {other.error}")
        return faults + run_folder.differences(self.whole(variant), run_folder.contents(output))


def choose(random, campaign, wish):
    """A variant and the moments of its kills, at random; `wish`: the number of the chain, so that each kind has its turn."""
    variant = (
        two_capsules.FORCED if wish % 10 == 9
        else two_capsules.THROUGH_FILES if wish % 10 == 4
        else two_capsules.RECORDED if wish % 10 == 6
        else two_capsules.EXTENDED if wish % 10 == 2
        else (two_capsules.PLAIN, two_capsules.CORRECTED)[wish % 2]
    )  # fmt: skip
    campaign.whole(variant)
    seconds = campaign.seconds[campaign.name_of_whole(variant)]
    n_resumes = random.choice([0, 1, 1, 2])
    if variant.extends:
        first = moments.InWrite(random.choice(["echo", "parameters", "table", "series"]))
    elif variant.replaces:
        gone = ["checkpoints", "fluid.pvd", "membrane", "observables.csv", "parameters.toml", "echo.toml"]
        first = moments.AsEarlierRunGoes(random.choice(gone))
    else:
        first = _moment(random, campaign.program.n_steps, seconds, starting=False)
    return variant, [first] + [_moment(random, campaign.program.n_steps, seconds, starting=True) for _ in range(n_resumes)]


def _moment(random, n_steps, seconds, starting):
    """A moment of a run of so many seconds; of one that goes on, mostly while it starts up, reads and cuts."""
    kind = random.random()
    if starting and kind < 0.35:
        return moments.Instant(random.uniform(0, 0.15 * seconds), "while it starts up")
    if starting and kind < 0.6:
        return moments.InWrite(random.choice(["table", "parameters", "series", "series"]))
    if kind < 0.65:
        return moments.AfterStep(random.randrange(-1, n_steps), random.uniform(0, 4 * seconds / n_steps))
    if kind < 0.75:
        return moments.BeforeOldestGoes(random.choice([random.randrange(n_steps // 2), n_steps]))
    what = random.choice(["fluid of a checkpoint", "membrane of a checkpoint", "membrane file", "fluid file", "series", "echo", "table"])
    many = {"echo": 1, "table": 1, "series": 2}.get(what, n_steps // (4 * two_capsules.Every.checkpoint))
    return moments.InWrite(what, random.randint(1, many))


def run(program, n_kills, random, report):
    """Kills until so many have struck. @return (chains, faults of two runs in one folder)"""
    campaign = Campaign(program)
    chains, n_struck, n_idle = [], 0, 0
    while n_struck < n_kills and n_idle < 20:
        variant, chosen = choose(random, campaign, len(chains))
        chain = campaign.chain(variant, chosen[: n_kills - n_struck])
        chains.append(chain)
        n_struck += len(chain.kills)
        n_idle = 0 if chain.kills else n_idle + 1  # a moment that is never met
        n_wrong = sum(bool(done.faults) for done in chains)
        report(f"{n_struck} of {n_kills} kills, {len(chains)} runs ended, {len(chains) - n_wrong} bit for bit")
    return chains, campaign.two_in_one_folder()


def table(chains):
    """The rows of the report: moment, kills during a run, during a resume, of them in runs that ended bit for bit."""
    rows = collections.defaultdict(lambda: [0, 0, 0])
    for chain in chains:
        for kill in chain.kills:
            for name in (kill.met, f"({kill.variant})"):
                row = rows[name]
                row[0 if kill.during == "run" else 1] += 1
                row[2] += not chain.faults
    return [(name, *rows[name]) for name in sorted(rows, key=lambda name: (name.startswith("("), name))]
