"""Five kills of the campaign in tests/faults. Usage: faults_test.py TANKTREAD [unittest arguments]."""

import pathlib
import sys
import unittest

from post_fixture import ROOT, InFolder

sys.path.insert(0, str(ROOT / "tests/faults"))

import kills  # noqa: E402
import moments  # noqa: E402
import run_folder  # noqa: E402
import two_capsules  # noqa: E402

N_KILLS = 5
# A run and, after it, resumes, each killed at a moment of its own. Moments of a run are chosen by how far it has come; a resume
# is killed so soon after its start that most of the run is still before it.
CHAINS = [
    (two_capsules.PLAIN, [moments.AfterStep(14), moments.Instant(0.02)]),
    (two_capsules.CORRECTED, [moments.InWrite("fluid of a checkpoint", 3)]),
    (two_capsules.PLAIN, [moments.BeforeOldestGoes(18), moments.InWrite("series")]),
]


class Kills(InFolder):
    program = None  # tanktread

    def setUp(self):
        super().setUp()
        self.campaign = kills.Campaign(two_capsules.Program(self.program, self.folder / "runs", n_steps=60))

    def test_killed_runs_go_on_and_end_as_the_whole_one_bit_for_bit(self):
        n_struck = 0
        # On a machine that is busy enough a moment may be missed: then its turn comes again.
        for variant, chosen in 4 * CHAINS:
            chain = self.campaign.chain(variant, chosen)
            self.assertEqual(chain.faults, [], "\n".join(chain.faults))
            n_struck += len(chain.kills)
            if n_struck >= N_KILLS:
                return
        self.fail(f"only {n_struck} kills struck")

    def test_a_run_killed_at_its_very_end_is_rid_of_what_it_had_no_time_to_remove(self):
        whole = self.campaign.whole(two_capsules.PLAIN)
        output = self.campaign.whole_folder(two_capsules.PLAIN)
        oldest = output / "checkpoints/step_0000000048"  # half removed
        oldest.mkdir()
        (oldest / "fluid.vti").write_bytes(whole["checkpoints/step_0000000054/fluid.vti"])
        ended = self.campaign.program.do(self.campaign.program.resume(two_capsules.PLAIN, output))
        self.assertEqual((ended.code, ended.error), (0, ""))
        self.assertIn("the run is at its end", ended.output)
        self.assertEqual(run_folder.differences(whole, run_folder.contents(output)), [])


class WhatIsFound(InFolder):
    """The comparison sees what a broken run would leave."""

    def setUp(self):
        super().setUp()
        for name in ("whole", "other"):
            (self.folder / name / "membrane").mkdir(parents=True)
            (self.folder / name / "membrane/membrane_0000000000.vtu").write_text("zero")
            (self.folder / name / "membrane.pvd").write_text(self.series("membrane/membrane_0000000000.vtu"))
            (self.folder / name / "observables.csv").write_text("step,D\n0,0.25\n")
        self.other = self.folder / "other"

    def series(self, *files):
        entries = "".join(f'    <DataSet timestep="{k}" file="{file}"/>\n' for k, file in enumerate(files))
        return f"<VTKFile>\n  <Collection>\n{entries}  </Collection>\n</VTKFile>\n"

    def found(self):
        whole = run_folder.contents(self.folder / "whole")
        return run_folder.faults_a_reader_meets(self.other, whole), run_folder.differences(whole, run_folder.contents(self.other))

    def test_nothing_where_nothing_is_wrong(self):
        self.assertEqual(self.found(), ([], []))

    def test_half_a_file(self):
        (self.other / "membrane/membrane_0000000000.vtu").write_text("ze")
        met, differing = self.found()
        self.assertEqual(len(met), 1)
        self.assertEqual(differing, ["membrane/membrane_0000000000.vtu: differs"])

    def test_half_a_row(self):
        (self.other / "observables.csv").write_text("step,D\n0,0.2")
        self.assertEqual(len(self.found()[0]), 1)

    def test_a_series_that_names_what_is_not_there_or_is_cut_off(self):
        (self.other / "membrane/membrane_0000000000.vtu").unlink()
        self.assertEqual(len(self.found()[0]), 1)
        (self.other / "membrane.pvd").write_text("<VTKFile>\n  <Coll")
        self.assertEqual(len(self.found()[0]), 1)

    def test_what_a_killed_process_left(self):
        (self.other / ".echo.toml.1-0.tmp").write_text("half")
        self.assertEqual(self.found(), ([], [".echo.toml.1-0.tmp: is too much"]))


if __name__ == "__main__":
    Kills.program = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
