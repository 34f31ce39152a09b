"""ensonify graph of launch files and of live runs."""
import json
import pathlib
import shutil
import tempfile
import unittest

from live_run import LAUNCH, LiveRun, tool


class Graph(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ens-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.launch = self.folder / "stubs.yaml"
        self.launch.write_text(LAUNCH.replace("FINISH", "9.0").replace("TRANSPORT", "transport: ipc"))

    def graph(self, *words):
        return tool("graph", *words)

    def test_the_graph_of_a_live_run_is_that_of_its_launch_file(self):
        code, from_file, error = self.graph(self.launch, "--json", "--all")
        self.assertEqual(code, 0, error)
        with LiveRun() as run:
            self.assertEqual(run.json("graph", "--all"), json.loads(from_file))
        edges = {(e["topic"], e["to"], e["delay_ns"]) for e in json.loads(from_file)["edges"]}
        self.assertEqual(edges, {("auv/pose", "pilot", 0), ("auv/pose", "bow", 0), ("bow/ping", "viewer", 0),
                                 ("pilot/command", "auv", 100_000_000)})

    def test_text_names_rates_sizes_and_delays(self):
        code, text, _ = self.graph(self.launch)
        self.assertEqual(code, 0)
        self.assertRegex(text, r"(?m)^  bow/ping +ping_blob/1 +20 Hz +51 kB  -> viewer.ping$")
        self.assertIn("  reads pilot/command as command, delayed 100 ms\n", text)
        self.assertNotIn("health", text)

    @unittest.skipUnless(shutil.which("dot"), "Graphviz is not installed")
    def test_graphviz_draws_it(self):
        svg, png = self.folder / "a.svg", self.folder / "a.png"
        code, _, error = self.graph(self.launch, "--svg", svg, "--png", png)
        self.assertEqual(code, 0, error)
        self.assertIn("<title>pilot&#45;&gt;auv</title>", svg.read_text())
        self.assertEqual(png.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(self.graph(self.launch, "--svg", "/nowhere/a.svg")[0], 2)

    def test_a_mistake_in_the_wiring_is_named_and_the_rest_is_drawn(self):
        self.launch.write_text(self.launch.read_text().replace("in: [{port: ping, type: ping_blob/1}]",
                                                               "in: [{port: ping, type: pign_blob/1}]"))
        code, text, error = self.graph(self.launch)
        self.assertEqual(code, 2)
        self.assertIn("viewer.ping: no publisher offers pign_blob/1", error)
        self.assertRegex(text, r"(?m)^  bow/ping .*-> nobody$")

    def test_wrong_files_and_arguments(self):
        for words, cause in (((self.folder / "none.yaml",), "no such file"),
                             ((self.launch, "--run", "x"), "excludes"),
                             ((self.launch, "--dot", "--json"), "excludes"),
                             ((self.launch, "--set", "bow.rate_hx=1"), "rate_hx")):
            code, text, error = self.graph(*words)
            self.assertEqual((code, text), (2, ""), error)
            self.assertIn(cause, error)


if __name__ == "__main__":
    unittest.main()
