"""The report: one HTML file that needs nothing else, plots as files, and the figures as CSV."""

import csv
import html
import itertools
import json
from pathlib import Path

import plots
from summary import BUSY, NOISE_SHARE, TARGET, measured, own_relmse, verdict

HERE = Path(__file__).resolve().parent


# A white pixel: the picture of no difference.
BLANK = ("data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' width='16' height='9'%3E"
         "%3Crect width='16' height='9' fill='white'/%3E%3C/svg%3E")


def escape(text):
    return html.escape(str(text))


def interval(estimate, digits=3):
    if estimate is None:
        return "-"
    text = f"{estimate['value']:.{digits}g}"
    if estimate["low"] is not None:
        text += f" ({estimate['low']:.{digits}g} to {estimate['high']:.{digits}g})"
    return text


def table(head, rows, css=""):
    """Cells are texts, or (text, class)."""
    def cell(value):
        text, css = value if isinstance(value, tuple) else (value, None)
        return f"<td{f' class={css}' if css else ''}>{escape(text)}</td>"

    return (f'<div class="scroll{" " + css if css else ""}"><table><thead><tr>' + "".join(f"<th>{escape(h)}</th>" for h in head) + "</tr></thead><tbody>"
            + "".join("<tr>" + "".join(map(cell, row)) + "</tr>" for row in rows) + "</tbody></table></div>")


def figure(svg, caption):
    return f"<figure>{svg}<figcaption>{caption}</figcaption></figure>"


def file_names(scenes):
    """For each scene a name for files and anchors, that no other has."""
    names = {}
    for scene in scenes:
        plain = "".join(c if c.isalnum() else "-" for c in scene)
        candidates = itertools.chain([plain], (f"{plain}-{n}" for n in itertools.count(2)))
        names[scene] = next(name for name in candidates if name not in names.values())
    return names


VERDICTS = {"best": "the default is the most efficient", "within 10 %": "the default is within 10 % of the most efficient",
            "worse": "the default is NOT within 10 % of the most efficient", "open": "undecided whether the default is within 10 % of the best"}


def verdict_text(configurations):
    """Whether the default is as good as the best configuration."""
    found = verdict(configurations)
    if not found:
        return "undecided: the reference has too few samples to measure the default's error"
    best = "" if found["verdict"] == "best" else f": {found['best']} has {interval(found['advantage'])} times its efficiency"
    return f"{VERDICTS[found['verdict']]}{best}, by CPU time"


def verdict_lines(summary):
    """The verdicts of all scenes."""
    for scene, configurations in summary.items():
        yield f"{scene}: {verdict_text(configurations)}"


def errors_table(configurations):
    times = list(next(iter(configurations.values()))["at"])
    spp = next((f["at_spp"]["spp"] for f in configurations.values() if f["at_spp"]), None)
    head = ["configuration", "samples/s", "slope of RMSE", *(f"relMSE at {t} s" for t in times),
            *([f"relMSE at {spp} spp"] if spp else []), f"s to relMSE {TARGET:g}"]
    rows = []
    for name, f in configurations.items():
        target = interval(f["to_target"]) + (" *" if f["to_target"] and not f["to_target"]["reached"] else "")
        rows.append([name, f"{f['samples_per_second']:.3g}", interval(f["slope"]), *(interval(f["at"][t]) for t in times),
                     *([interval(f["at_spp"])] if spp else []), target])
    return table(head, rows)


MARK = " \N{DAGGER}"
FEWEST_TESTED = 16  # samples a pixel from which equal means are tested: 4 of a noisy light sampling were called different


def mark_of(figures):
    return MARK if figures["unmeasured_ends"] else ""


def footnote(configurations, seeds):
    """Whose efficiency is not that of the end; nothing if all are."""
    early = [f"{name} ({f['unmeasured_ends']} of {seeds} runs)" for name, f in configurations.items() if f["unmeasured_ends"]]
    if not early:
        return ""
    return (f'<p class="note early">{MARK}: the last error is no measurement, since the reference\'s own hides it; the efficiency is '
            f"that of an earlier point: {escape(', '.join(early))}.</p>")


def mean_verdict(figures):
    """Whether the image shown could have the mean of the reference: a cell."""
    if not figures["views"]:
        return "-"
    if figures["viewed_spp"] < FEWEST_TESTED:
        return f"too few samples: {figures['viewed_spp']}"
    return ("different", "bad") if figures["views"]["statistical"]["different"] else ("agrees", "good")


def efficiency_table(configurations, seconds, relative_to):
    head = ["configuration", f"efficiency / {relative_to}", "the same by CPU time", f"FLIP at {seconds:g} s", "mean against the reference"]
    rows = []
    for name, f in configurations.items():
        views = f["views"]
        rows.append([name + mark_of(f), interval(f["efficiency_ratio"]), interval(f["cpu_efficiency_ratio"]),
                     f"{views['flip']:.3g}" if views else "-", mean_verdict(f)])
    return table(head, rows)


def color_bar(configurations):
    """What the colours of all signed errors of a scene mean; nothing without views."""
    colors = next((f["views"]["colors"] for f in configurations.values() if f["views"]), None)
    if not colors:
        return ""
    stops = ", ".join("rgb(" + " ".join(f"{100 * level:.4g}%" for level in c["color"]) + ")" for c in colors)
    low, high = (f"{colors[end]['difference']:+.2g}" for end in (0, -1))
    return (f'<p class="colors">{low}<i style="background: linear-gradient(to right, {stops})"></i>{high}</p><p class="note">Colours of the '
            "signed error, image less reference in luminance, alike for all images of this scene: full at what 99 % of the pixels of the "
            "first one stay below.</p>")


def viewer(scene, name, configurations, reference):
    views = {"reference": {"picture": reference["picture"]}}
    views.update({name: f["views"] for name, f in configurations.items() if f["views"]})
    names = list(views)
    options = ["".join(f"<option{' selected' if n == chosen else ''}>{escape(n)}</option>" for n in names)
               for chosen in (names[min(1, len(names) - 1)], names[0])]
    data = json.dumps({n: {k: v[k] for k in ("picture", "difference") if k in v} for n, v in views.items()})
    return f"""<div class="viewer" id="viewer-{escape(name)}" data-blank="{BLANK}">
<div class="controls"><label>left <select>{options[0]}</select></label><label>right <select>{options[1]}</select></label>
<label>slider <input type="range" min="0" max="100" value="50"></label>
<label><input type="checkbox"> signed error</label></div>
<div class="stage" tabindex="0" role="img" aria-label="two images of {escape(scene)}"><img alt=""><img alt=""></div>
<p class="caption" aria-live="polite"></p><div class="gallery"></div>{color_bar(configurations)}<p class="note keys">Click, space or enter flips; arrows choose images; e shows the signed error.</p>
<script type="application/json">{data.replace('</', '<' + chr(92) + '/')}</script></div>"""


HOW_TO_READ = """<p class="note">In brackets: 95 % confidence over seeds. Efficiency: 1 / (relMSE x seconds) at the last measured
point of each run, paired by seed. By CPU time: of all threads, in which other work on the machine does not count. FLIP: the difference that an eye
sees when both images are flipped, from 0 to 1. The mean against the reference: lemma compare --statistical, from 16 samples a
pixel on; with few, values are far from normal, and its alarms more than stated. FLIP, this test and the images are of the first seed. Slope: of the root of relMSE
over samples; independent samples have -0.5. Rare bright samples hold much of relMSE in some
scenes: a run's error rises where it meets one. The verdict: by the value of the best one's advantage; NOT within 10 % only where all of its interval lies
above 1.1, else undecided. A run that ends up to a fifth before a time counts there with its last error; - where a run did not
last as long or has no measured point before. * not reached by all runs: goes on with the error as one over the time.</p>"""


def warnings(configurations):
    """What makes a scene's figures doubtful."""
    left_out = sum(f["unmeasured"] for f in configurations.values())
    if left_out:
        yield (f"The reference has too few samples: {left_out} points are left out, since their squared error is not above "
               f"{NOISE_SHARE:g} of the reference's own. Raise --reference-spp.")
    uneven = {name: f["sample_spread"] for name, f in configurations.items() if f["sample_spread"] > BUSY}
    if uneven:
        name = max(uneven, key=uneven.get)
        yield (f"The machine was busy: samples in the same time differ by more than {BUSY:g} times between seeds in {len(uneven)} of "
               f"{len(configurations)} configurations, most for {name}, {uneven[name]:.2g} times. Ratios are paired by seed, which "
               "removes what slowed a whole turn; errors at times are not.")


def scene_section(scene, name, results, folder):
    configurations, reference = results["summary"][scene], results["references"][scene]
    stats = reference["stats"]
    noise = stats["estimated_error"]["relmse"]
    seconds = results["effort"]["seconds"]
    parts = [f'<h2 id="{escape(name)}">{escape(scene)}</h2>',
             f"<p>{escape(stats['model'])}; {stats['width']} x {stats['height']} pixels. Reference: {stats['spp']} samples a pixel, "
             f"{escape(stats['integrator'])} with lights {escape(stats['lights'])}, seed {stats['seed']}; its own relMSE is "
             f"{interval(noise)}, which is subtracted from all errors.</p>",
             *(f'<p class="warning">{escape(text)}</p>' for text in warnings(configurations))]
    for key, unit in (("seconds", "seconds of rendering"), ("spp", "samples a pixel")):
        svg = plots.save(plots.error_plot(configurations, key, unit, f"{name}-{key}"), folder, f"{name}-{key}")
        parts.append(figure(svg, f"Error against {unit}: further down and left is better. Bands: 95 % over {results['effort']['seeds']} seeds, "
                              "cut at the plot's edge. Full points: numbers of samples that all seeds reached; open point: "
                              "where the runs end, each with its own number."))
    svg = plots.save(plots.efficiency_plot(configurations, results["relative_to"]), folder, f"{name}-efficiency")
    text = verdict_text(configurations)
    parts += [figure(svg, f"Efficiency after {seconds:g} s; twice the efficiency is the same error in half the time. Bars: 95 % over seeds."), f'<p class="verdict">{escape(text[0].upper() + text[1:])}.</p>',
              efficiency_table(configurations, seconds, results["relative_to"]),
              footnote(configurations, results["effort"]["seeds"]), errors_table(configurations),
              HOW_TO_READ,
              f"<h3>Images after {seconds:g} s</h3>", viewer(scene, name, configurations, reference)]
    return "\n".join(parts)


def accelerator_section(results, folder):
    parts = ['<h2 id="accelerators">Accelerators</h2>']
    if results["traversal"]:
        cases = results["traversal"]["cases"]
        parts.append(figure(plots.save(plots.traversal_plot(cases), folder, "traversal"), "./run bench-traversal --ratios"))
        rows = [[c["case"], kind, f"{t['grid_rays_per_s']:.3g}", f"{t['embree_rays_per_s']:.3g}", f"{t['ratio']:.2f}"]
                for c in cases for kind, t in c["trace"].items()]
        parts += [table(["case", "rays", "grid, rays/s", "Embree, rays/s", "grid / Embree"], rows),
                  '<p class="note">primary-batch: camera rays, 16 at a time, as the renderer hands them over; all others one by one.</p>']
    rows = []
    for report in results["parity"]:
        for accel in report["accelerators"]:
            t = accel["total"]
            faults = t["wrong"] + t["missed"] + t["wrong_occlusion"]
            rows.append([report["scene"], accel["accel"], t["rays"], t["decided"], t["wrong"], t["missed"],
                         t["wrong_occlusion"], ("exact", "good") if faults == 0 else (f"{faults} faults", "bad")])
    parts += ["<h3>Parity: answers against exact arithmetic</h3>",
              table(["scene", "accelerator", "rays", "decided", "wrong", "missed", "occlusion", "verdict"], rows),
              '<p class="note">Decided: float32 leaves one answer; the others pass an edge or vertex within rounding, or meet two triangles '
              "at once. Wrong: another triangle, or a distance beyond its error bound; missed: nothing where there is a surface; occlusion: wrong on "
              "whether anything is hit.</p>"]
    if results["hard_cases"]:
        rows = [[h["case"], h["backend"], h["expected"], h["tried"],
                 (str(h["faults"]), "good" if h["faults"] == 0 else "bad"), h["allowed"]] for h in results["hard_cases"]]
        parts += ["<h3>Hard cases</h3>", table(["case", "accelerator", "expected", "tried", "faults", "allowed"], rows, "hard"),
                  '<p class="note">Allowed: 0, or "shown" where an accelerator is not held to the case: what it does is told, and is no '
                  "failure.</p>"]
    return "\n".join(parts)


def peer_section(results):
    """Whether converged images of other renderers have the mean of our references."""
    if not results["peers"]:
        return ""
    rows = []
    for p in results["peers"]:
        test = p["statistical"]
        z = max(test["global_z"], key=abs)
        rows.append([p["scene"], p["peer"], p["spp"], f"{max(0, p['relmse']):.2g}", f"{z:+.2f} of {test['global_limit']:.2f}",
                     f"{test['worst_block']['z']:+.2f} of {test['block_limit']:.2f}", f"{test['block_alarms']} of {test['block_tests']}",
                     ("different", "bad") if test["different"] else ("agrees", "good")])
    head = ["scene", "renderer", "spp", "relMSE", "largest z of the image", "largest z of a block", "block alarms", "verdict"]
    return ('<h2 id="peers">Other renderers</h2><p>The same camera, triangles, box filter, lights, reflection, length of paths and '
            "begin of roulette, rendered by others with as many threads; their curves are among ours above. Here their converged "
            "images are tested against our references for equal means (lemma compare --statistical).</p>" + table(head, rows))


def write_csv(results, path):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["scene", "configuration", "seed", "spp", "seconds", "cpu_seconds", "rmse", "relmse", "measured"])
        for r in results["renderings"]:
            noise = own_relmse(results["references"][r["scene"]])
            for p in r["figures"]["error_curve"]:
                writer.writerow([r["scene"], r["configuration"], r["seed"], p["spp"], p["seconds"], p["cpu_seconds"], p["rmse"],
                                 p["relmse"], int(measured(p, noise))])


def write_report(results, folder):
    """Writes report.html, plots/ and errors.csv into the folder; returns the page's path."""
    plot_folder = folder / "plots"
    plot_folder.mkdir(parents=True, exist_ok=True)
    machine, effort = results["machine"], results["effort"]
    names = file_names(results["summary"])
    sections = [scene_section(scene, name, results, plot_folder) for scene, name in names.items()]
    accelerators = accelerator_section(results, plot_folder) + peer_section(results)
    links = "".join(f'<a href="#{escape(name)}">{escape(scene)}</a>' for scene, name in names.items())
    page = f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,"><title>Lemma: speed against error</title>
<style>{(HERE / 'style.css').read_text()}</style></head><body>
<h1>Lemma: speed against error</h1>
<p>{escape(results['version'])}, commit {escape(results['commit'])}, {escape(', '.join(results['libraries']))}; {escape(machine['processor'])}, {machine['threads']} threads,
{machine['memory_gb']} GB, {escape(machine['system'])}; {escape(results['date'])}. Each configuration rendered {effort['size']} pixels for {effort['seconds']:g} s
with {effort['seeds']} seeds, in turns. relMSE is the mean of (I - R)<sup>2</sup> / (R<sup>2</sup> + 0.01).</p>
<nav>{links}<a href="#accelerators">Accelerators</a>{'<a href="#peers">Other renderers</a>' if results['peers'] else ''}</nav>
{''.join(sections)}
{accelerators}
<script>{(HERE / 'viewer.js').read_text()}</script>
</body></html>
"""
    path = folder / "report.html"
    path.write_text(page, encoding="utf-8")
    write_csv(results, folder / "errors.csv")
    return path
