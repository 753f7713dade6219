"""The page of a run: how it ended, how far to trust it, its sand, what it did over time, and where its time went."""

import math
import os

from tamp import files
from tamp.charts import choices, movie, over_time, page, particles, sand, sand_charts, timeline
from tamp.charts.chart import Table
from tamp.charts.formatting import NO_NUMBER, counted, escaped, is_number, number_text, percent_text, plain, si_text
from tamp.charts.over_time import Line, Plot
from tamp.charts.run_history import History, axes_of_force, force, is_plane

ENERGIES = ["kinetic", "elastic", "plastic", "viscous", "contact", "filter", "external", "total"]
MOST_BYTES = 4_900_000  # of a page
GLOSSARY = ("imbalance: costliest patch over the mean; gain: by how much a step gets shorter, by replay, if the task "
            "takes 10 % less, or no time")


def read_run(folder):
    """The files of a run. `page` and `scene` are None where the program has not prepared the page, `step` where none
    was traced."""
    run = {name: read(folder / f"{name}.json", plain_document) for name in ("summary", "profile")}
    for name in ("history", "machine"):
        run[name] = read(folder / f"{name}.csv", History)
    run["scene"] = read(folder / "scene.json", plain_document)
    run["page"] = read(folder / "page.json", plain_document)
    run["step"] = read(folder / "trace.json", lambda path: timeline.read_step(files.document(path)))
    run["views"] = read(folder / "page.json", lambda path: particles.views(run["page"])) or []
    run["folder"] = folder
    run["sand"] = sand.read(read(folder / "scene.json", lambda path: sand.wanted(run)))
    return run


def plain_document(path):
    return plain(files.document(path))


def read(path, how):
    """None where there is no such file."""
    with files.written_by_tamp(path):
        return how(path) if os.path.exists(path) else None


def write(run, folder):
    (folder / "report.html").write_text(whole_page(run), encoding="utf-8")


def whole_page(run):
    before, after = above_sand(run), below_sand(run)
    moving = movie.section(run["sand"], MOST_BYTES - len((before + after).encode()))
    script = (page.HERE / "movie.js").read_text(encoding="utf-8") if moving else ""
    return page.whole_page(f"{run['summary']['scene']}: a run", f"<main>\n{before}{moving}{after}</main>\n",
                           kind="compare", script=script)


def above_sand(run):
    summary = run["summary"]
    content = of(run, "summary.json", lambda: head(summary)) + of(run, "history.csv", lambda: way_in(run))
    return content + of(run, "summary.json", lambda: trust(summary)) + sand_charts.section(run["sand"])


def below_sand(run):
    summary, profile = run["summary"], run["profile"]
    content = the_scene(run) + "<h2>Over time</h2>\n"
    content += of(run, "history.csv", lambda: charts(plots(run), "plot"))
    content += "<h2>Where the time went</h2>\n" + of(run, "profile.json", lambda: time_of_steps(profile))
    content += of(run, "trace.json", lambda: one_step(run["step"]))
    content += of(run, "profile.json", lambda: tasks_and_waits(profile))
    levels = of(run, "summary.json", lambda: memory_levels(summary))
    content += "<h2>Memory use</h2>\n"
    content += of(run, "machine.csv", lambda: charts(memory_plots(run["machine"], levels), "memory"))
    return content + of(run, "profile.json", lambda: page.as_html(memory(profile)))


def of(run, name, make):
    """The result of `make` from a file of the run, which is named where it is damaged."""
    with files.written_by_tamp(run["folder"] / name):
        return make()


def head(summary):
    text = f"<h1>{escaped(summary['scene'])}</h1>\n<p class=\"faint\">{lead(summary)}</p>\n"
    return text + part_of_whole(summary) + warnings(summary)


def part_of_whole(summary):
    n_parts = (summary.get("part_of_whole") or {}).get("factor", 1)
    return f"<p>Forces, energies and masses are those of 1/{n_parts} of the whole.</p>\n" if n_parts > 1 else ""


def trust(summary):
    return "<h2>How far to trust it</h2>\n" + page.as_html(monitors(summary))


def charts(plots, name):
    return page.beside(page.figure(over_time.chart(plot, f"{name}-{k + 1}")) for k, plot in enumerate(plots))


# --- the way in ---


def way_in(run):
    found = penetration(run)
    return "<h2>Force against depth</h2>\n" + charts(found, "penetration") if found else ""


# --- what was run ---


def the_scene(run):
    scene, prepared = run["scene"], run["page"]
    if scene is None or prepared is None:
        return ""
    text = "<h2>The scene</h2>\n" + of(run, "scene.json", lambda: title_and_bodies(scene))
    text += of(run, "page.json", lambda: pictures(run["views"], prepared.get("no_pictures")))
    left_out = run["summary"].get("left_out")  # older runs do not say
    chosen = choices.table(
        of(run, "page.json", lambda: choices.word_rows(prepared["words"], left_out)),
        of(run, "scene.json", lambda: choices.contact_rows(scene, left_out) + choices.number_rows(scene, left_out)),
        of(run, "summary.json", lambda: choices.cell_rows(run["summary"]["bodies"])))
    return text + "<h2>What was chosen</h2>\n" + page.as_html(chosen, "words")


def title_and_bodies(scene):
    return f"<p>{escaped(scene['title'])}. {escaped(bodies(scene))}</p>\n"


def pictures(views, why=None):
    if why:
        return f"<p>There are no pictures of the run: {escaped(why)}.</p>\n"
    if not views:
        return "<p>The run wrote no fields, from which its particles could be drawn.</p>\n"
    return page.beside(page.figure(particles.chart(view, f"particles-{k + 1}")) for k, view in enumerate(views))


def bodies(scene):
    return "; ".join(f"{name}: {described(body)}" for name, body in scene["bodies"].items()) + "."


def described(body):
    speed = speed_text(body)
    return ("rigid " if body["rigid"] else "") + body["material"] + (f", initial speed {speed}" if speed else "")


def speed_text(body):
    speed = math.hypot(*(v for v in body["velocity"] if is_number(v))) if body.get("velocity") else 0
    return si_text(speed, "m/s") if speed > 0 else ""


# --- how it ended ---


def lead(summary):
    ended = f"{summary['status'].capitalize()} after {counted(summary['steps'], 'step')}, "
    ended += f"{si_text(summary['simulated_time_s'], 's')} simulated in {si_text(summary['wall_s'], 's')}: "
    return escaped(ended + f"{counted(summary['particles']['total'], 'particle')}, "
                   f"{counted(summary['patches'], 'patch', 'patches')}, {counted(summary['ranks'], 'rank')} of "
                   f"{counted(summary['threads'], 'thread')}. TAMP {summary['version']}.")


def warnings(summary):
    said = [text for text in [summary["reason"], *summary["warnings"]] if text]
    return "".join(f"<p><strong>{escaped(text)}</strong></p>\n" for text in said)


def monitors(summary):
    """The monitors with a limit, the worst first."""
    watched = {name: m for name, m in summary["monitors"].items() if isinstance(m, dict) and m.get("limit")}
    rows = [[name.replace("_", " "), percent_text(m["share"]), percent_text(m["limit"]), first_seen(m["first"])]
            for name, m in sorted(watched.items(), key=lambda item: -item[1]["share"] / item[1]["limit"])]
    return Table(["monitor", "share", "limit", "first seen"], rows)


def first_seen(first):
    return f"after step {first['after_step']}, {si_text(first['time_s'], 's')}" if first else NO_NUMBER


# --- over time ---


def plots(run):
    history = run["history"]
    if history is None:
        return []
    made = [plot_of(history, "Energies", "energy", "J", [name for name in ENERGIES if name in history.columns])]
    if history.ending("depth") and not penetration(run):
        made.append(of_each(history, "Depth", "depth", "m"))
    made += [of_each(history, f"Velocity along {axis}", f"velocity_{axis}", "m/s") for axis in moving_axes(history)]
    for ending, title in [("p_max", "Largest mean stress"), ("q_max", "Largest deviatoric stress")]:
        lines = [line for line in of_each(history, title, ending, "Pa").lines if line.name not in rigid(run["scene"])]
        if lines:
            made.append(Plot(title, ending.replace("_", " "), "Pa", lines))
    made.append(plot_of(history, "Step size", "step size", "s", ["dt"]))
    return in_units(run, made)


def rigid(scene):
    """The materials of rigid bodies, which have no stress."""
    return {body["material"] for body in scene["bodies"].values() if body["rigid"]} if scene else set()


def penetration(run):
    """The force on each body over its depth, and their depths over time; nothing where there is no such body."""
    history = run["history"]
    if history is None:
        return []
    axes = axes_of_force(run["scene"], run.get("summary"))
    made = [force_against_depth(history, body, axes) for body in history.ending("depth") if force(history, body, axes)]
    return in_units(run, [*made, of_each(history, "Depth", "depth", "m")]) if made else []


def in_units(run, made):
    return [per_metre(plot) for plot in made] if is_plane(run["scene"]) else made


def per_metre(plot):
    """Energies and forces of a plane scene are those of a slab one metre thick."""
    if plot.y_unit not in ("J", "N"):
        return plot
    return plot._replace(y_name=f"{plot.y_name} per metre across the plane", y_unit=f"{plot.y_unit}/m")


def moving_axes(history):
    """Along which some body is a hundredth as fast as along any."""
    fastest = {}
    for axis in "xyz":
        speeds = [abs(v) for body in history.ending(f"velocity_{axis}")
                  for v in history.columns[f"{body}.velocity_{axis}"] if is_number(v)]
        fastest[axis] = max(speeds, default=0)
    return [axis for axis, speed in fastest.items() if speed > 0.01 * max(fastest.values())]


def plot_of(history, title, name, unit, columns):
    return Plot(title, name, unit, [history.line(column, column) for column in columns])


def of_each(history, title, ending, unit):
    return Plot(title, ending.replace("_", " "), unit,
                [history.line(owner, f"{owner}.{ending}") for owner in history.ending(ending)])


def force_against_depth(history, body, axes="xyz"):
    """On its way in: rows that are deeper than all before."""
    line = Line(body, [], [])
    for x, y in zip(history.columns[f"{body}.depth"], force(history, body, axes)):
        if is_number(x) and is_number(y) and x > (line.x[-1] if line.x else 0):
            line.x.append(x)
            line.y.append(y)
    return Plot(f"Force on {body} against its depth", "force", "N", [line], x_name="depth", x_unit="m",
                through_blow=True)


# --- where the time went ---


def time_of_steps(profile):
    text = (f"A step takes {si_text(profile['step_s'], 's')} on average; no number of threads makes it shorter than "
            f"its longest chain of tasks, {si_text(profile.get('longest_chain_s'), 's')}. "
            f"{si_text(profile.get('between_s'), 's')} pass between two steps, for output and the history. "
            f"Scheduler overhead is {percent_text(profile['overhead'])} of the workers' time in steps.")
    if profile.get("too_busy"):
        text += (" The machine was too busy to trust these times: other programs had its cores for "
                 f"{percent_text(1 - profile['core_share'])} of the time of tasks.")
    return f"<p>{escaped(text)}</p>\n"


def one_step(step):
    if step is None:
        return "<p>No step was traced (<code>--trace-steps</code>), so that none can be drawn.</p>\n"
    return page.figure(timeline.chart(step, "timeline"))


def tasks_and_waits(profile):
    text = page.as_html(tasks(profile)) + f'<p class="faint">{GLOSSARY}</p>\n'
    if profile.get("waits"):
        text += "<h2>What workers waited for</h2>\n" + page.as_html(waits(profile))
    return text


def tasks(profile):
    rows = [[t["name"], f"{t['count']}", si_text(t["mean_s"], "s"), si_text(t["p95_s"], "s"), percent_text(t["share"]),
             number_text(t["imbalance"]), percent_text(t.get("step_gain_if_a_tenth_faster")),
             percent_text(t.get("step_gain_if_free"))] for t in profile["tasks"]]
    return Table(["task", "count", "mean", "95th percentile", "share", "imbalance", "gain at -10 %", "gain if free"],
                 rows)


def waits(profile):
    return Table(["before", "waited for", "time of all workers"],
                 [[w["task"], w["waits_for"], si_text(w["s"], "s")] for w in profile["waits"]])


def memory_levels(summary):
    return [("labels, at most", summary["ledger_peak_bytes"]),
            ("forecast of all", summary["forecast"]["memory_bytes"])]


def memory_plots(machine, levels):
    """Memory of the processes, beside the most that the fields take and the forecast of all."""
    if machine is None or not machine.columns["time"]:
        return []
    held = machine.line("resident, all ranks", "rss")
    ends = [held.x[0], held.x[-1]]
    lines = [held] + [Line(name, ends, [level, level]) for name, level in levels if is_number(level)]
    return [Plot("Memory", "memory", "B", lines)]


def memory(profile):
    largest = sorted(profile["memory"]["labels"].items(), key=lambda item: -item[1])[:12]
    rows = [[name, si_text(n_bytes, "B")] for name, n_bytes in largest if n_bytes > 0]
    return Table(["label, the largest", "at most"], [*rows, ["all", si_text(profile["memory"]["total"], "B")]])
