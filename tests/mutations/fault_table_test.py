#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The table of faults: what it takes, what it refuses, and what a source with faults says."""

import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the checkout stays as it is

from fault_table import Fault, TableError, place_of, planted, read_table


def fault(text, name="wrong"):
    return Fault(name, "core/some.cpp", "area", "it hurts", (), text)


def table(text):
    with tempfile.NamedTemporaryFile("w", suffix=".txt", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        return read_table(file.name)


class Planting(unittest.TestCase):
    def test_expression_keeps_its_original(self):
        wrong = fault("if (⟦ a < b ⇒ a <= b ⟧)")
        self.assertIn(f"if ((::warren::planted({wrong.number}) ? (a <= b) : (a < b))) x();",
                      planted("if (a < b) x();", [wrong]))

    def test_statement_may_be_left_out(self):
        wrong = fault("⟦ x(); ⇒ ⟧ y();")
        self.assertIn(f"{{ if (::warren::planted({wrong.number})) {{  }} else {{ x(); }} }} y();",
                      planted("x(); y();", [wrong]))

    def test_text_is_found_whatever_its_line_breaks(self):
        self.assertEqual(place_of(fault("f(a, ⟦ b ⇒ c ⟧);"), "g();\nf(a,\n    b);\n"), (14, 15))

    def test_text_must_be_there_once(self):
        for source in ("", "f(a); f(a);"):
            with self.assertRaisesRegex(TableError, "wrong: its text is (not found|found 2 times) in core/some.cpp"):
                place_of(fault("f(⟦ a ⇒ b ⟧);"), source)

    def test_two_faults_share_a_text_but_do_not_overlap(self):
        first, second = fault("f(⟦ a ⇒ b ⟧", "first"), fault("f(⟦ a ⇒ c ⟧", "second")
        self.assertIn(f"planted({first.number}) ? (b) : ((::warren::planted({second.number}) ? (c) : (a)))",
                      planted("f(a + d);", [first, second]))
        with self.assertRaisesRegex(TableError, "overlaps"):
            planted("f(a + d);", [first, fault("f(⟦ a + d ⇒ 0 ⟧)", "second")])


class Table(unittest.TestCase):
    def test_fault_has_area_reason_and_place(self):
        one, = table("[area]\nwrong: core/some.cpp\nwhy: it hurts\nnear: core/a_test.cpp\n  f(⟦ a ⇒ b ⟧);\n")
        self.assertEqual((one.name, one.file, one.area, one.why, one.near, one.text.strip()),
                         ("wrong", "core/some.cpp", "area", "it hurts", ("core/a_test.cpp",), "f(⟦ a ⇒ b ⟧);"))

    def test_what_is_missing_is_named(self):
        for text, message in (("[area]\nwrong: a.cpp\n  f(⟦ a ⇒ b ⟧)\n", "wrong: has no area or no line that says why"),
                              ("[area]\nwrong: a.cpp\nwhy: it hurts\n  f(a)\n", "wrong: its text needs one pair"),
                              ("[area]\nwrong: a.cpp\nwhy: it hurts\n  f(⟦ a && ⇒ ⟧ b)\n", "wrong: a &&: neither a statement"),
                              ("[area]\nwrong: a.cpp\nwhy: it hurts\n  f(⟦ a, b ⇒ b, a ⟧)\n", "wrong: a, b: neither a statement"),
                              ("[area]\nwrong: a.cpp\nwhy: it hurts\n  f(⟦ g(a ⇒ g(b ⟧))\n", r"wrong: g\(a: neither a statement"),
                              ("[area]\nwrong: a.cpp\nwhy: it hurts\n  f(⟦ a ⇒ ⟧)\n", "wrong: nothing: neither a statement"),
                              ("what is this?\n", ":1: neither an area")):
            with self.assertRaisesRegex(TableError, message):
                table(text)


if __name__ == "__main__":
    unittest.main()
