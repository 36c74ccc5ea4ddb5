"""Which file of a .pvd series is of which time, and reading a series while a run adds to it."""

import threading
import unittest

from post_fixture import InFolder, write_series

from tanktread_post import series


class Series(InFolder):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "fluid.pvd"

    def named(self, entry):
        return None if entry is None else (entry[0], entry[1].name)

    def test_a_file_that_is_named_again_is_of_its_first_time(self):
        write_series(self.file, [(0.0, "a"), (0.25, "a"), (0.5, "b"), (0.75, "b"), (1.0, "c")])
        self.assertEqual(len(series.read_series(self.file)), 5)
        self.assertEqual([self.named(entry) for entry in series.read_files(self.file)], [(0.0, "a"), (0.5, "b"), (1.0, "c")])
        # The nearest file, not the entry there: b is 0.1 from 0.4, a 0.4.
        self.assertEqual([self.named(series.at(self.file, t)) for t in (0.2, 0.4, 0.76, None)], [(0.0, "a"), (0.5, "b"), (1.0, "c"), (1.0, "c")])
        # The last one until then, whether it is named again or not.
        for entries in ([(0.0, "a"), (0.25, "a"), (0.5, "b"), (1.0, "c")], [(0.0, "a"), (0.5, "b"), (1.0, "c")]):
            write_series(self.file, entries)
            shown = [self.named(series.shown_at(self.file, t)) for t in (-1.0, 0.0, 0.49, 0.5, 0.99, 9.0)]
            self.assertEqual(shown, [(0.0, "a"), (0.0, "a"), (0.0, "a"), (0.5, "b"), (0.5, "b"), (1.0, "c")])

    def test_a_series_without_files(self):
        write_series(self.file, [])
        for file in (self.file, self.folder / "none.pvd"):
            self.assertEqual((series.read_files(file), series.at(file, 1.0), series.shown_at(file, 1.0)), ([], None, None))

    def test_a_half_that_a_run_is_adding_to_is_looked_at_again(self):
        write_series(self.file, [(0.0, "a")])
        whole = self.file.read_text()
        self.file.write_text(whole[:-20])
        # Whole again after the first look, before the last.
        writer = threading.Timer(2 * series.PAUSE, lambda: self.file.write_text(whole))
        writer.start()
        self.assertEqual(len(series.read_series(self.file)), 1)
        writer.join()

    def test_a_half_that_stays_is_refused(self):
        write_series(self.file, [(0.0, "a")])
        self.file.write_text(self.file.read_text()[:-20])
        self.assert_refused(["fluid.pvd", "damaged"], series.read_series, self.file)


if __name__ == "__main__":
    unittest.main()
