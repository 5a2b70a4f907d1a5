# SPDX-License-Identifier: BSD-3-Clause
"""Why an end is blocked; and what explain=True tells: what became of samples and motions, where it is narrow, what would
likely help."""
import json
from typing import NamedTuple, Optional, Tuple


class BlockedEnd(NamedTuple):
    """Why the body does not fit at the start or the goal.

    `end` is "start" or "goal", `by` what is in the way. `free_place` is a state near it where the body fits, `distance` how
    far away that is; both are None where none was found. `hint` says what may have been meant, or None. `room` is there
    between what is in the way and the body (of a disc its middle), `needed` the room that it needs; `depth` is how far the
    body would have to go to be out of what is in the way, None where it does not stand in it.

    Fields are taken by their names as well: `blocked["by"]` is `blocked.by`.

    Examples
    --------
    >>> import warren
    >>> blocked = warren.solve("maze:5x5", (1, 1), (9, 9)).blocked
    >>> blocked.end, blocked.by
    ('goal', 'outside of the box of the obstacles 0.5 0.5 5.5 5.5')
    >>> len(blocked.free_place), blocked["free_place"] == blocked.free_place
    (2, True)
    """

    end: str
    by: str
    free_place: Optional[Tuple[float, ...]]
    distance: Optional[float]
    hint: Optional[str]
    room: float
    needed: float
    depth: Optional[float]

    def __getitem__(self, key):
        if not isinstance(key, str):
            return tuple.__getitem__(self, key)
        if key not in self._fields:
            raise KeyError(key)
        return getattr(self, key)


class SampleCounts(NamedTuple):
    """Samples of all rounds: drawn, kept as milestones, and dropped."""

    drawn: int
    kept: int
    dropped: int


class MotionCounts(NamedTuple):
    """Motions that the world was asked about: free, blocked, and undecided where they are too close to tell."""

    checked: int
    free: int
    blocked: int
    undecided: int


class ComponentFacts(NamedTuple):
    """Components of prm's roadmap, start and goal in it: how many, milestones in all, in the largest, components of one
    alone, milestones that start and goal can reach, and whether the two are joined."""

    number: int
    milestones: int
    largest: int
    alone: int
    of_start: int
    of_goal: int
    joined: bool


class NarrowPlace(NamedTuple):
    """Where the body has least room along a path: the leg (from 0), a place on it (None: of an arm), the room there, and
    of so many uniform samples one falls into a square as wide (None: the path is not over samples)."""

    leg: int
    place: Optional[Tuple[float, float]]
    clearance: float
    one_sample_in: Optional[float]


class Hint(NamedTuple):
    """What would likely help: options of the program to add or replace (none: it takes more than an option), why, and the
    command whose options they are ("build" for a kept roadmap; None: of what was asked)."""

    options: Tuple[str, ...]
    why: str
    command: Optional[str]

    @property
    def keywords(self):
        """The options as keywords, to be tried as they stand.

        Examples
        --------
        >>> import warren
        >>> warren.Hint(("--samples", "400"), "more of them", None).keywords
        {'samples': '400'}
        """
        words = [part for word in self.options for part in (word.split("=", 1) if word.startswith("--") else [word])]
        return {name[2:].replace("-", "_"): value for name, value in zip(words[::2], words[1::2])}


class Explanation(NamedTuple):
    """What an answer means, of those that were asked with `explain=True`.

    `components` is None where the planner has no roadmap in which edges lead both ways, `narrowest` where there is no
    path, or one that touches; `hints` are there where there is no path, or where
    more turns may better it, the likeliest first; `stopped_by` names the limit
    that ended the explanation before it was whole ("budget", "memory", a signal).

    Examples
    --------
    >>> import warren
    >>> asked = dict(planner="prm", sampler="uniform", samples=300, explain=True)
    >>> explained = warren.solve("maze:15x15", **asked).explained
    >>> explained.samples, explained.components.joined
    (SampleCounts(drawn=300, kept=243, dropped=57), False)
    >>> hint = explained.hints[0]
    >>> hint.keywords
    {'samples': '1200'}
    >>> bool(warren.solve("maze:15x15", **{**asked, **hint.keywords}))
    True
    """

    samples: SampleCounts
    motions: MotionCounts
    components: Optional[ComponentFacts]
    narrowest: Optional[NarrowPlace]
    hints: Tuple[Hint, ...]
    stopped_by: Optional[str]


for _named in (BlockedEnd, SampleCounts, MotionCounts, ComponentFacts, NarrowPlace, Hint, Explanation):
    _named.__module__ = "warren"


def narrow_place(parsed):
    if parsed is None:
        return None
    return NarrowPlace(**{**parsed, "place": parsed["place"] and tuple(parsed["place"])})


def explanation(text):
    """Of the value of the key `explained`."""
    parsed = json.loads(text)
    components = parsed["components"] and tuple(parsed["components"].values())  # in the order of ComponentFacts
    hints = (Hint(tuple(hint["options"]), hint["why"], hint["command"]) for hint in parsed["hints"])
    return Explanation(SampleCounts(**parsed["samples"]), MotionCounts(**parsed["motions"]),
                       components and ComponentFacts(*components), narrow_place(parsed["narrowest"]), tuple(hints),
                       parsed["stopped_by"])
