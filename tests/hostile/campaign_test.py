#!/usr/bin/env python3
"""The campaign's judge, with programs in place of `pas` that do each thing it must see."""
import pathlib
import stat
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import campaign
from mutations import BROKEN, HARMLESS, VALUE

SHOW = campaign.Command("show", "show scene.yaml", ["scene.yaml"])


class Judge(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.work = pathlib.Path(self.place.name)
        (self.work / "corpus").mkdir()
        (self.work / "corpus/scene.yaml").write_text("good\n")

    def tearDown(self):
        self.place.cleanup()

    def verdict(self, on_broken, expected=BROKEN, accepted=(), name="broken"):
        """What is said of a program that runs a line of Python when the scene is broken."""
        program = self.work / "program"
        program.write_text(f"#!{sys.executable}\nimport sys, os, signal, time\n"
                           "text = open('scene.yaml').read()\n"
                           f"if text == 'broken':\n    {on_broken}\nelse:\n    print('1 plane')\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        trial = campaign.Campaign(str(program), self.work, list(accepted))
        return trial.judge(campaign.Case("scene.yaml", name, expected, b"broken", SHOW), 0).outcome

    def test_sees_a_crash(self):
        self.assertEqual(self.verdict("os.kill(os.getpid(), signal.SIGSEGV)"), campaign.CRASH)
        self.assertEqual(self.verdict("sys.exit(134)"), campaign.CRASH)

    def test_sees_a_hang(self):
        limit, campaign.MAX_SECONDS = campaign.MAX_SECONDS, 1
        try:
            self.assertEqual(self.verdict("time.sleep(60)"), campaign.HANG)
        finally:
            campaign.MAX_SECONDS = limit

    def test_sees_too_much_memory(self):
        limit, campaign.MAX_BYTES = campaign.MAX_BYTES, 100 << 20
        try:
            self.assertEqual(self.verdict("b'x' * (200 << 20)"), campaign.MEMORY)
        finally:
            campaign.MAX_BYTES = limit

    def test_sees_text_of_exceptions(self):
        self.assertEqual(self.verdict("sys.exit(print('scene.yaml: std::bad_alloc') or 2)"), campaign.RAW)

    def test_sees_a_changed_result_without_a_word(self):
        self.assertEqual(self.verdict("print('2 planes')"), campaign.SILENT)
        self.assertEqual(self.verdict("print('1 plane')"), campaign.NO_EFFECT)
        self.assertEqual(self.verdict("print('2 planes')", VALUE), campaign.ACCEPTED)
        self.assertEqual(self.verdict("print('warning: scene.yaml: 2 planes')"), campaign.WARNED)

    def test_sees_whether_a_refusal_names_the_file(self):
        self.assertEqual(self.verdict("sys.exit(print('pas: scene.yaml:3: no') or 2)"), campaign.REFUSED)
        self.assertEqual(self.verdict("sys.exit(print('pas: no') or 2)"), campaign.UNCLEAR)

    def test_wants_harmless_changes_to_change_nothing(self):
        self.assertEqual(self.verdict("print('1 plane')", HARMLESS), campaign.NO_EFFECT)
        self.assertEqual(self.verdict("print('2 planes')", HARMLESS), campaign.REFUSED_GOOD)
        self.assertEqual(self.verdict("sys.exit(2)", HARMLESS), campaign.REFUSED_GOOD)

    def test_takes_what_was_reviewed_and_nothing_else(self):
        reviewed = [("show", "scene.*", "an unknown *")]
        self.assertEqual(self.verdict("print('2 planes')", accepted=reviewed), campaign.SILENT)
        self.assertEqual(self.verdict("print('2 planes')", accepted=reviewed, name="an unknown key"),
                         campaign.NO_EFFECT)
        self.assertEqual(self.verdict("sys.exit(134)", accepted=reviewed, name="an unknown key"), campaign.CRASH)


if __name__ == "__main__":
    unittest.main()
