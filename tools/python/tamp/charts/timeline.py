"""The timeline of one step of a run: what each worker of each rank did when, from the run's trace."""

import math
from typing import NamedTuple

from tamp.charts.axes import NARROW, Entry, Sheet, set_ticks, text_width
from tamp.charts.chart import Table, make_chart
from tamp.charts.formatting import counted, percent_text, plain, si_text
from tamp.charts.over_time import HALF
from tamp.charts.theme import HUES, LIGHT, N_SHADES, Style, hue
from tamp.files import Damage

FULL = HALF._replace(name="full", width=984)
MOST_BARS, MOST_LANES = 900, 32
ROW = 26  # height of a lane
MESSAGES = "messages"


class Bar(NamedTuple):
    """From when to when, in seconds from the start of the step; of one task, or of `n` that are drawn as one."""

    start: float
    end: float
    phase: str
    task: str
    n: int = 1
    busy: float = 0  # the part of that time that its tasks took

    @property
    def text(self):
        what = self.task if self.n == 1 else f"{self.n} in a row, mostly {self.task}"
        return f"{what}: {si_text(self.end - self.start, 's')}, after {si_text(self.start, 's')}"


class Step(NamedTuple):
    number: int
    duration: float
    lanes: dict  # bars in the order of time, by (rank, worker); messages of a rank come after its workers
    n_traced: int  # steps that the trace has


# --- from the trace ---


def read_step(trace):
    """The traced step whose duration is nearest to the median's, but not the first; None where there is none."""
    spans = [event for event in trace["traceEvents"] if event["ph"] == "X" and "step" in event.get("args", {})]
    durations = {}
    for event in spans:
        if event["cat"] == "step":
            number = event["args"]["step"]
            durations[number] = max(durations.get(number, 0), event["dur"])
    if not durations:
        return None
    if not all(0 < time < math.inf for time in durations.values()) or any(event["dur"] < 0 for event in spans):
        raise Damage("what takes no time")
    number = typical(durations)
    chosen = [event for event in spans if event["args"]["step"] == number]
    begin = min(event["ts"] for event in chosen)
    return Step(number, 1e-6 * durations[number], lanes_of(chosen, begin), len(durations))


def typical(durations):
    later = {number: time for number, time in durations.items() if number != min(durations)} or durations
    median = sorted(later.values())[(len(later) - 1) // 2]
    return min(number for number, time in later.items() if time == median)


def lanes_of(events, begin):
    lanes = {}
    for event in sorted(events, key=lambda event: event["ts"]):
        if event["cat"] == "step":
            continue
        is_message = event["cat"] == "message"
        lane = (event["pid"], MESSAGES if is_message else event["tid"])
        start, length = 1e-6 * (event["ts"] - begin), 1e-6 * event["dur"]
        phase = MESSAGES if is_message else plain(event["cat"])
        lanes.setdefault(lane, []).append(Bar(start, start + length, phase, task_of(event), 1, length))
    return dict(sorted(lanes.items(), key=lambda item: (item[0][0], item[0][1] == MESSAGES, str(item[0][1]).zfill(6))))


def task_of(event):
    text, args = plain(event["name"]), event["args"]
    if "material" in args and not text.endswith(f": {plain(args['material'])}"):
        text += f", {plain(args['material'])}"
    return text + (f", patch {args['patch']}" if "patch" in args else "")


# --- what is drawn of it ---


def first_lanes(step):
    return dict(list(step.lanes.items())[:MOST_LANES])


def fewer(lanes, duration, most=MOST_BARS):
    """Lanes in which neighbours are joined until no more bars than that are left, or each lane has one."""
    gap = duration / 4000
    alike = True
    while sum(map(len, lanes.values())) > most and gap > 0 and any(len(bars) > 1 for bars in lanes.values()):
        lanes = {lane: joined(bars, gap, alike) for lane, bars in lanes.items()}
        # First neighbours of the same phase, then any that are short.
        alike, gap = gap < duration / 200 and not alike, 1.3 * gap
    return lanes


def joined(bars, gap, alike):
    """Neighbours that follow within a gap; of one phase, or of any as long as each is no longer than the gap."""
    made = bars[:1]
    for bar in bars[1:]:
        last = made[-1]
        is_short = bar.end - bar.start <= gap and last.end - last.start <= gap
        if bar.start - last.end <= gap and (bar.phase == last.phase if alike else is_short):
            longer = max(last, bar, key=lambda one: one.busy / one.n)
            made[-1] = Bar(last.start, max(last.end, bar.end), longer.phase, longer.task, last.n + bar.n,
                           last.busy + bar.busy)
        else:
            made.append(bar)
    return made


def shares(step):
    """The phases, the longest first, each with its part of what all workers did."""
    times = {}
    for (_, worker), bars in step.lanes.items():
        for bar in bars if worker != MESSAGES else []:
            times[bar.phase] = times.get(bar.phase, 0) + bar.busy
    whole = sum(times.values()) or 1
    return {phase: time / whole for phase, time in sorted(times.items(), key=lambda item: -item[1])}


def colours(step):
    """Colours of the phases; those of the longest differ most, and messages are in the colour of text."""
    there_are = [hue(k, k // len(HUES)) for k in range(len(HUES) * N_SHADES)]
    found = {phase: there_are[k] if k < len(there_are) else LIGHT["front"] for k, phase in enumerate(shares(step))}
    return {**found, MESSAGES: LIGHT["faint"]}


def lane_name(step, lane):
    rank, worker = lane
    several = len({rank for rank, _ in step.lanes}) > 1
    what = worker if worker == MESSAGES else f"worker {worker}"
    return f"rank {rank}, {what}" if several else what


def chart(step, name):
    return make_chart(name, f"Step {step.number}", describe(step), caption(step), table(step),
                      lambda layout: draw(step, layout), (FULL, NARROW))


def draw(step, layout):
    shown = fewer(first_lanes(step), step.duration)
    paint, found = colours(step), shares(step)
    labels = [lane_name(step, lane) for lane in shown]
    entries = [Entry(f"{phase} ({percent_text(found[phase], 2)})" if phase in found else phase,
                     Style(paint[phase]), filled=True)
               for phase in [*found, *([MESSAGES] if any(worker == MESSAGES for _, worker in shown) else [])]]
    left = 14 + max(text_width(label, layout.font) for label in labels)
    sheet = Sheet(layout, f"Step {step.number}", "", "time in the step", entries, height=ROW * len(shown), left=left)
    axis = sheet.axis
    set_ticks(axis, "x", (0, end_of(step)), lambda tick: si_text(tick, "s"), logarithmic=False)
    axis.set(ylim=(len(shown), 0), yticks=[])
    tips = {}
    for row, (label, bars) in enumerate(zip(labels, shown.values())):
        axis.annotate(label, (0, row + 0.5), (-6, 0), textcoords="offset points", ha="right", va="center_baseline",
                      size=layout.font - 0.5, color=LIGHT["ink"])
        for bar in bars:
            key = f"bar-{len(tips)}"
            tips[key] = bar.text
            thin = 0.3 if bar.phase == MESSAGES else 0.12
            axis.fill([bar.start, bar.end, bar.end, bar.start], [row + thin] * 2 + [row + 1 - thin] * 2,
                      facecolor=paint[bar.phase], lw=0, gid=key)
    sheet.tips = tips
    return sheet, []


def end_of(step):
    return max([step.duration, *(bar.end for bars in step.lanes.values() for bar in bars)])


# --- the words ---


def busy_parts(step):
    return {lane: sum(bar.busy for bar in bars) / step.duration for lane, bars in step.lanes.items()
            if lane[1] != MESSAGES}


def describe(step):
    n_tasks = sum(bar.n for (_, worker), bars in step.lanes.items() if worker != MESSAGES for bar in bars)
    parts = [f"{lane_name(step, lane)} works for {percent_text(part, 2)} of it"
             for lane, part in list(busy_parts(step).items())[:MOST_LANES]]
    phases = ", ".join(f"{phase} {percent_text(share, 2)}" for phase, share in shares(step).items())
    return (f"Step {step.number} takes {si_text(step.duration, 's')} for {counted(n_tasks, 'task')}: "
            f"{'; '.join(parts)}. Of what workers do: {phases}.")


def caption(step):
    text = (f"The median of the {counted(step.n_traced, 'traced step')} ({si_text(step.duration, 's')}). "
            "Each bar is a task on a patch; its name shows under the mouse.")
    if sum(map(len, first_lanes(step).values())) > MOST_BARS:
        text += " Short neighbours are drawn as one."
    if len(step.lanes) > MOST_LANES:
        text += f" Of {len(step.lanes)} lanes the first {MOST_LANES} are drawn."
    if any(worker == MESSAGES for _, worker in step.lanes):
        text += " Messages lie with their receiver, from being posted to being unpacked."
    return text


def table(step):
    rows = {}
    for (_, worker), bars in step.lanes.items():
        for bar in bars:
            n, busy, longest = rows.get(bar.phase, (0, 0, 0))
            rows[bar.phase] = n + bar.n, busy + bar.busy, max(longest, bar.busy)
    ordered = sorted(rows.items(), key=lambda item: (item[0] == MESSAGES, -item[1][1]))
    return Table(["phase", "tasks", "time of all workers", "longest"],
                 [[phase, f"{n}", si_text(busy, "s"), si_text(longest, "s")] for phase, (n, busy, longest) in ordered])
