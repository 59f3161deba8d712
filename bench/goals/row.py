"""A row of the table: what we measure, beside what somebody else, or a limit, does."""
import dataclasses


@dataclasses.dataclass
class Row:
    """`ours` and `other` are in `unit`. `gain`: other / ours, so that more is better; `goal`: the least gain wanted.

    `was`: the same number of ours by an earlier build (--was), measured in turns with today's."""
    what: str
    unit: str
    ours: float
    other: float
    compared: str
    goal: float | None = None
    was: float | None = None
    more_is_better: bool = False  # of a number like percent of the peak

    @property
    def gain(self):
        return self.ours / self.other if self.more_is_better else self.other / self.ours

    def cells(self):
        verdict = "" if self.goal is None else "met" if self.gain >= self.goal else "missed"
        return [self.what, self.unit, number(self.was), number(self.ours), number(self.other), number(self.gain),
                number(self.goal), verdict, self.compared]


HEAD = ["what", "unit", "was", "ours", "other", "gain", "goal", "", "other is"]


def number(value):
    return "" if value is None else f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
