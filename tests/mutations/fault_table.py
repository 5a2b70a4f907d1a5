# SPDX-License-Identifier: BSD-3-Clause
"""The table of faults, and how a source is made to hold them all.

A line "[area]" opens a group. Each fault is a line "name: file", a line "why: ..." in words, maybe a line "near: FILE ..."
with tests that are asked first, and, indented, a piece of the file that occurs in it exactly once, whatever its line
breaks, in which the original and the fault stand between brackets:

    if (⟦ s_a * s_b > 0 ⇒ s_a * s_b >= 0 ⟧) return false;

An original that ends in a semicolon, or in one and a brace, is a statement, any other one a whole expression; a fault of nothing
leaves the statement out. Faults of one and the same text may share it.
"""

import dataclasses
import re
import zlib

BRACKETS = re.compile(r"⟦(.*?)⇒(.*?)⟧", re.DOTALL)
STATEMENT = re.compile(r";\s*\}?$")
NO_BEGIN = re.compile(r"(?:&&|\|\||[-+*/%&]\s|[<>=!]=|[/%<>=,|?:.])")
NO_END = re.compile(r"(?<!\+)\+$|(?<!-)-$|[*/%<>=,&|?:!.]$")
TITLE = re.compile(r"([a-z][a-z0-9_]*): +(\S+)$")


class TableError(Exception):
    """The table says something that can't be done: one line."""


@dataclasses.dataclass
class Fault:
    name: str
    file: str
    area: str
    why: str = ""
    near: tuple = ()
    text: str = ""

    @property
    def number(self):
        """By which the running program knows it: of the name alone, so that other faults come and go."""
        return zlib.crc32(self.name.encode()) % 0x7FFFFFFF + 1

    def parts(self):
        """What stands before the original, the original, the fault, and what stands behind."""
        found = BRACKETS.search(self.text)
        if not found or BRACKETS.search(self.text, found.end()):
            raise TableError(f"{self.name}: its text needs one pair of brackets ⟦original ⇒ fault⟧")
        return self.text[: found.start()], found[1].strip(), found[2].strip(), self.text[found.end() :]


def read_table(path):
    faults, area = [], ""
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.rstrip()
            title = TITLE.match(line)
            if not line or line.startswith("//"):
                continue
            if line.startswith("["):
                area = line.strip("[]")
            elif line.startswith("  ") and faults:
                faults[-1].text += line[2:] + "\n"
            elif line.startswith("why: ") and faults:
                faults[-1].why = line[5:]
            elif line.startswith("near: ") and faults:
                faults[-1].near = tuple(line.split()[1:])
            elif title:
                faults.append(Fault(title[1], title[2], area))
            else:
                raise TableError(f"{path}:{number}: neither an area, a fault, nor a part of one: {line}")
    check(faults)
    return faults


def is_expression(text):
    """Whether it may stand between parentheses: no operator waits for its other side, no bracket for its other half, and
    no comma makes two of it."""
    opened = {")": "(", "]": "[", "}": "{"}
    waiting = []
    for mark in re.sub(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'|<[\w:, ]+>', "0", text):
        if mark in "([{":
            waiting.append(mark)
        elif mark in opened and (not waiting or waiting.pop() != opened[mark]):
            return False
        elif mark in ",;" and not waiting:
            return False
    return bool(text) and not waiting and not NO_BEGIN.match(text) and not NO_END.search(text)


def check(faults):
    numbers = {}
    for fault in faults:
        _, original, wrong, _ = fault.parts()
        for text in () if STATEMENT.search(original) else (original, wrong):
            if not is_expression(text):
                raise TableError(f"{fault.name}: {text or 'nothing'}: neither a statement nor a whole expression")
        if not fault.why or not fault.area:
            raise TableError(f"{fault.name}: has no area or no line that says why it would hurt")
        other = numbers.setdefault(fault.number, fault)
        if other is not fault:
            raise TableError(f"{fault.name}: another fault has this name, or one of the same number: {other.name}")


def pattern_of(text):
    """Finds the text whatever white space there is between its words."""
    return r"\s+".join(re.escape(word) for word in text.split())


def place_of(fault, source):
    """Where in the source the fault's original stands."""
    before, original, _, behind = fault.parts()
    gaps = [r"\s*" if part.strip() else "" for part in (before, behind)]
    pattern = f"{pattern_of(before)}{gaps[0]}({pattern_of(original)}){gaps[1]}{pattern_of(behind)}"
    found = list(re.finditer(pattern, source))
    if len(found) != 1:
        how = "is not found" if not found else f"is found {len(found)} times"
        raise TableError(f"{fault.name}: its text {how} in {fault.file}")
    return found[0].span(1)


def planted_text(original, faults):
    """The original, and each fault for when it is chosen."""
    statement = STATEMENT.search(original)
    text = original
    for fault in reversed(faults):
        chosen, wrong = f"::warren::planted({fault.number})", fault.parts()[2]
        if statement:
            text = f"{{ if ({chosen}) {{ {wrong} }} else {{ {text} }} }}"
        else:
            text = f"({chosen} ? ({wrong}) : ({text}))"
    return text


def planted(source, faults):
    """The source with these faults, of one file, planted."""
    places = {}
    for fault in faults:
        places.setdefault(place_of(fault, source), []).append(fault)
    end = len(source) + 1
    for (first, last), here in sorted(places.items(), reverse=True):
        if last > end:
            raise TableError(f"{here[0].name}: its original overlaps that of another fault in {here[0].file}")
        source = source[:first] + planted_text(source[first:last], here) + source[last:]
        end = first
    return '#include "core/planted.hpp"\n' + source
