"""`ensonify convert`: a record's survey as the logger writes it live, byte for byte; what it says where a record holds less."""
import subprocess
import unittest

import support

SECONDS = 6
SEABED_IMAGE = "  bow:   { run: multibeam, config: { seabed_image: { published: true } } }\n"
WITHOUT_LOGGER = support.bay(SECONDS, "[bow/soundings, bow/seabed_image, nav/*]").replace("  bow:   { run: multibeam }\n", SEABED_IMAGE)
WITH_LOGGER = WITHOUT_LOGGER + "  log: { run: logger, config: { head: bow, formats: [all, kmall, xtf], ship: Alkor, line: 12, position_rate_hz: 10 } }\n"
NAME = "0012_20250601_120000_Alkor.all"


class Convert(support.SystemTest):
    def record(self, launch=WITH_LOGGER):
        result = self.run_launch(launch, timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        return result.out

    def convert(self, *words):
        done = self.tool("convert", *words, timeout=120)
        left = list(self.folder.rglob(".convert-*"))
        self.assertEqual(left, [])
        return done

    def test_bytes_are_those_of_the_live_logger(self):
        out = self.record()
        done = self.convert(out, "--to", "all,kmall,xtf", self.folder / "made")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        names = [NAME, NAME.replace(".all", ".kmall"), NAME.replace(".all", ".xtf")]
        self.assertEqual(sorted(done.stdout.split()), [str(self.folder / "made" / name) for name in names])
        for name in names:
            self.assertEqual((self.folder / "made" / name).read_bytes(), (out / name).read_bytes(), name)

    def test_a_record_of_a_run_without_a_logger_takes_parameters_from_the_command_line(self):
        live = self.record()
        wanted = (live / NAME).read_bytes()
        out = self.record(WITHOUT_LOGGER)
        plain = self.convert(out, "--to", "all", self.folder / "plain")  # its only head with soundings
        self.assertEqual(plain.returncode, 0, plain.stderr)
        sets = "ship=Alkor", "line=12", "position_rate_hz=10"
        done = self.convert(out, "--to", "all", "--head", "bow", *(word for one in sets for word in ("--set", one)), self.folder / "made")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "made" / NAME).read_bytes(), wanted)

    def test_what_a_logger_reads_and_the_record_does_not_hold_is_named(self):
        out = self.record(WITH_LOGGER.replace("nav/*", "nav/estimate"))
        for words, missing in ((["--to", "all"], "holds no attitude/1"),):
            done = self.convert(out, *words, self.folder / "made")
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertIn(missing, done.stderr)
        another = WITH_LOGGER.replace("bow/seabed_image,", "bow/seabed_image, side/ping_main,") + "  side:  { run: sidescan, config: { quality: 0.1 } }\n"
        done = self.convert(self.record(another), "--to", "all,wcd", self.folder / "made")
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertIn("holds no ping/1 of bow, which a logger reads; record bow/ping for --to all,wcd", done.stderr)

    def test_without_a_seabed_image_it_says_so(self):
        out = self.record(WITH_LOGGER.replace(", bow/seabed_image", ""))
        done = self.convert(out, "--to", "all", self.folder / "made")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("no seabed image of bow", done.stderr)
        self.assertLess((self.folder / "made" / NAME).stat().st_size, (out / NAME).stat().st_size)

    def test_what_is_wrong_is_2_and_says_what_is_allowed(self):
        out = self.record()
        for words, said in [
                (["--head", "stern"], "--head stern: the record holds no soundings of it; it holds those of: bow"),
                (["--logger", "black_box"], "--logger black_box: the run had no such logger; it had: log"),
                (["--set", "line"], "line: is not KEY=VALUE"),
                (["--set", "formats=[xtf]"], "formats: is given by --to"),
                (["--set", "folder=elsewhere"], "folder: is given as DIR"),
                (["--set", "line=12000"], "line"),
                (["--set", "lime=3"], "lime"),
        ]:
            with self.subTest(words):
                done = self.convert(out, "--to", "all", *words, self.folder / "made")
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertIn(said, done.stderr)
                self.assertNotIn(".convert-", done.stderr)
        self.assertFalse((self.folder / "made").exists())
        bare = self.folder / "bare.mcap"
        subprocess.run([support.BUILD / "tests/write_sample_record", bare], check=True)
        done = self.convert(bare, "--to", "all")
        self.assertEqual(done.returncode, 2)
        self.assertIn("says nothing of its scenario", done.stderr)

    def test_a_full_disk_is_5_and_leaves_whole_datagrams(self):
        out, small = self.record(), self.folder / "small"
        small.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=600k", "none", str(small)], capture_output=True).returncode != 0:
            self.skipTest("no file system can be mounted here")
        try:
            done = self.convert(out, "--to", "all", small)
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertIn(NAME, done.stderr)
            self.assertEqual(self.tool("info", small / NAME).returncode, 0)
        finally:
            subprocess.run(["umount", "-l", str(small)], check=True)


if __name__ == "__main__":
    unittest.main()
