# SPDX-License-Identifier: GPL-2.0-or-later
"""Which events of a fault are slip †: what friction takes up within them, and how far the fault slips, compared with other times.

For each event:
  excess   frictional work within it, less what friction does in as much time between events, over its size, as in
           `postproc --where "excess > 0.5"`. 1: friction takes up what the springs lose; 0: it does no more than between events, so
           that the energy goes to the load or waves
  chance   share of random stretches of the run whose excess, over the size of the event, is above 0.5
The stretches are as long as the event, and no event of its size or more goes on in them.
An event counts as slip if its excess is above 0.5. As many as `chance` says would count at any other time, as some place of a
long fault slips nearly always: shares and rates of slip leave these out.
"""
import numpy as np

from lsm.history import History

__all__ = ["SLIP", "Friction", "excess_of", "judged", "recorded", "slip_share"]

STRETCHES = 40  # random stretches for each event
SLIP = 0.5  # an event with a larger excess counts as slip


class Friction(History):
    """Frictional work of the whole fault, summed over time."""

    def __init__(self, path):
        super().__init__(path)
        records = self.records[self.records["step_end"] > self.records["step_begin"]]
        self.steps = np.concatenate([records["step_begin"][:1], records["step_end"]]).astype(float)
        self.work = np.concatenate([[0.0], np.cumsum(records["work"].sum(axis=1, dtype=float))])

    def done(self, at):
        """Frictional work until a step."""
        return np.interp(at, self.steps, self.work)

    def worked(self, begin, end):
        return self.done(end) - self.done(begin)


def recorded(catalogue, history, begin):
    """The events >= 1e-4 from a time on that end within the history."""
    return catalogue[(catalogue["t_start"] >= begin) & (catalogue["size"] >= 1e-4) & (catalogue["step_end"] <= history.steps[-1])]


def random_starts(history, events, first):
    """Steps at which random stretches begin, STRETCHES for each event, as long, in which no event of its size or more goes on.

    A stretch that meets one is drawn again, a hundred times at most: the fault may be busy. In a history from step `first` on.
    """
    rng, begin, end = np.random.default_rng(1), events["step_start"].astype(float), events["step_end"].astype(float)
    lasting, size = end - begin, np.append(events["size"], 0.0)

    def busy(start, of):
        """Whether events of the sizes of those `of` go on in stretches."""
        places = np.stack([np.searchsorted(end, start, "right"), np.searchsorted(begin, start + lasting[of])])
        return (places[0] < places[1]) & (np.maximum.reduceat(size, places.T.ravel())[::2] >= size[of])

    for _ in range(STRETCHES):
        start, again = np.zeros(len(lasting)), np.arange(len(lasting))
        for _ in range(100):
            start[again] = rng.uniform(first, history.steps[-1] - lasting.max(), len(again))
            again = again[busy(start[again], again)]
        yield start


def friction_between(work, lasting, total, time):
    """Power of friction between events that take up `work` and last so long, of `total` in all of the time."""
    return (total - np.sum(work)) / (time - np.sum(lasting))


def judged(history, events, first):
    """Excess and chance of all events of a run, in order, in a history from step `first` on."""
    begin, end = events["step_start"].astype(float), events["step_end"].astype(float)
    work = events["friction_work"] if "friction_work" in events.dtype.names else history.worked(begin, end)  # step by step, if it was recorded
    rate = friction_between(work, end - begin, history.worked(first, history.steps[-1]), history.steps[-1] - first)

    def excess(work):
        return np.asarray((work - rate * (end - begin)) / events["size"])

    chance = np.zeros(len(begin))
    for start in random_starts(history, events, first):
        chance += excess(history.worked(start, start + end - begin)) > SLIP
    return excess(work), chance / STRETCHES


def excess_of(events):
    """Excess of the events of a catalogue, by their work of friction."""
    work, lasting = events["friction_work"], events["t_end"] - events["t_start"]
    total, time = events["friction_total"][-1] - events["friction_total"][0], events["t_end"][-1] - events["t_end"][0]
    return np.asarray((work - friction_between(work[1:], lasting[1:], total, time) * lasting) / events["size"])


def slip_share(excess, chance):
    """Share of events that are slip, beyond those that would count as slip by chance."""
    return (np.mean(excess > SLIP) - np.mean(chance)) / (1 - np.mean(chance))
