"""The plots of the report, drawn by matplotlib; each as SVG for the page and as SVG and PNG files."""

import io

import matplotlib
import numpy

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (the backend must be chosen before)
from summary import FIRST_FITTED  # noqa: E402

matplotlib.rcParams.update({
    "svg.fonttype": "none",  # text stays text
    "svg.hashsalt": "lemma",  # the same figures make the same file
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#dddddd",
    "figure.constrained_layout.use": True,
})
WIDTH = 5.6  # inches: as wide as a phone its text can still be read
LEGEND_COLUMNS = 2
# Okabe and Ito, Color Universal Design (2008), which colour-blind eyes tell apart; without yellow, which is faint on white.
COLORS = ("#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#D55E00", "#CC79A7")
DASHES = ("-", "--", "-.", ":")
MARKERS = ("o", "s", "^", "D", "v")


def style(index):
    """Of a curve: when all colours are taken, they come again with other dashes and markers."""
    turn = index // len(COLORS)
    return {"color": COLORS[index % len(COLORS)], "linestyle": DASHES[turn % len(DASHES)], "marker": MARKERS[turn % len(MARKERS)]}


def save(figure, folder, name):
    """Writes both files and returns the SVG element for the page."""
    svg = io.StringIO()
    figure.savefig(svg, format="svg", metadata={"Date": None})
    figure.savefig(folder / f"{name}.png", dpi=150)
    pyplot.close(figure)
    (folder / f"{name}.svg").write_text(svg.getvalue())
    return svg.getvalue()[svg.getvalue().index("<svg"):]


def _reference_slope(axes, work):
    """A line of slope -1, that of independent samples' squared error, through the upper left of the plot."""
    low, high = axes.get_ylim()
    xs = (min(work), max(work))
    ys = (high * 0.7, high * 0.7 * xs[0] / xs[1])
    axes.plot(xs, ys, color="#888888", linewidth=0.8, linestyle=(0, (1, 2)), label="independent samples (-1)")
    axes.set_ylim(low, high)


def fitted_slope(points, key):
    """Of the drawn curve, in the plot's own unit: relMSE over work, from FIRST_FITTED samples a pixel; None with fewer than two."""
    fitted = [(p[key], p["relmse"]["value"]) for p in points if p["spp"] >= FIRST_FITTED]
    if len(fitted) < 2:
        return None
    work, error = zip(*fitted)
    return float(numpy.polyfit(numpy.log(work), numpy.log(error), 1)[0])


def _draw_end(axes, last, end, key, look, identity):
    """From a curve's last point on to where the runs end: thin, with an open marker and its interval as a bar."""
    value, low, high = (end["relmse"][name] for name in ("value", "low", "high"))
    axes.plot((last[key], end[key]), (last["relmse"]["value"], value), color=look["color"], linewidth=0.8, linestyle=(0, (2, 2)))
    axes.plot(end[key], value, color=look["color"], marker=look["marker"], markersize=4, markerfacecolor="white", gid=identity)
    if low is not None:
        axes.plot((end[key], end[key]), (low, high), color=look["color"], linewidth=0.8)


def error_plot(configurations, key, unit, identity):
    """relMSE over seconds or samples, with bands of 95 % confidence over seeds. The curves' ids begin with `identity`."""
    figure, axes = pyplot.subplots(figsize=(WIDTH, 3.6 + 0.16 * -(-len(configurations) // LEGEND_COLUMNS)))
    work, errors = [], []
    for index, (name, figures) in enumerate(configurations.items()):
        points, end = figures["curve"], figures["end"]
        if not points:
            continue
        xs = [p[key] for p in points]
        work += xs
        errors += [p["relmse"]["value"] for p in points]
        slope = fitted_slope(points, key)
        axes.plot(xs, [p["relmse"]["value"] for p in points], markersize=2.5,
                  linewidth=2.6 if index == 0 else 1.3, zorder=4 if index == 0 else 2,  # the default on top
                  label=name if slope is None else f"{name} ({slope:.2f})", gid=f"{identity}-curve-{index}", **style(index))
        if end:
            _draw_end(axes, points[-1], end, key, style(index), f"{identity}-end-{index}")
            work.append(end[key])
            errors.append(end["relmse"]["value"])
        if points[0]["relmse"]["low"] is not None:
            axes.fill_between(xs, [p["relmse"]["low"] for p in points], [p["relmse"]["high"] for p in points],
                              color=style(index)["color"], alpha=0.15, linewidth=0)
    axes.set(xscale="log", yscale="log", xlabel=unit, ylabel="relMSE")
    if work:
        axes.set_ylim(min(errors) / 2, max(errors) * 2)  # by the means: bands of few seeds reach far
        _reference_slope(axes, work)
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.45, -0.14), ncol=LEGEND_COLUMNS, frameon=False,
                title="fitted slope in brackets", title_fontsize=8)
    return figure


def efficiency_plot(configurations, relative_to):
    """Efficiency as a ratio to that of one of them, with intervals."""
    names = [name for name, f in configurations.items() if f["efficiency_ratio"]]
    ratios = [configurations[name]["efficiency_ratio"] for name in names]
    figure, axes = pyplot.subplots(figsize=(WIDTH, 0.6 + 0.28 * len(names)))
    values = [r["value"] for r in ratios]
    errors = [[r["value"] - (r["low"] or r["value"]) for r in ratios], [(r["high"] or r["value"]) - r["value"] for r in ratios]]
    axes.barh(range(len(names)), values, xerr=errors, color=[style(i)["color"] for i in range(len(names))],
              error_kw={"elinewidth": 1.2, "capsize": 2, "ecolor": "#808080"})  # grey: seen on black, too
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.axvline(1, color="#444444", linewidth=0.8)
    if not names:
        return figure
    least, most = min(values) / 3, max(values) * 3
    for row, r in enumerate(ratios):  # an arrow where an interval goes on beyond the plot
        for end, edge, marker in ((r["low"], least, "<"), (r["high"], most, ">")):
            if end is not None and not least <= end <= most:
                axes.plot(edge, row, marker=marker, color="black", markersize=5, clip_on=False, gid=f"clipped-{row}")
    axes.set(xscale="log", xlim=(least, most),  # by the means: intervals of few seeds reach far
             xlabel=f"efficiency 1 / (relMSE x seconds) over that of: {relative_to}")
    return figure


def traversal_plot(cases):
    """Rays a second of grid over those of Embree."""
    rows = [(f"{case['case']}: {kind}", figures["ratio"]) for case in cases for kind, figures in case["trace"].items()]
    figure, axes = pyplot.subplots(figsize=(WIDTH, 0.6 + 0.22 * len(rows)))
    axes.barh(range(len(rows)), [ratio for _, ratio in rows], color=COLORS[4])
    axes.set_yticks(range(len(rows)), [name for name, _ in rows], fontsize=8)
    axes.invert_yaxis()
    axes.axvline(1, color="#444444", linewidth=0.8)
    axes.set(xscale="log", xlabel="rays a second, grid / Embree")
    return figure
