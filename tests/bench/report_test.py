"""The report in a real browser: Chromium without a window opens it, the plots are there, the viewer answers."""

import base64
import io
import re
import tempfile
import unittest
from pathlib import Path

try:
    import numpy
    from matplotlib import image as image_file
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.keys import Keys
except ImportError as missing:
    raise unittest.SkipTest(f"{missing}: apt install python3-matplotlib python3-selenium chromium-driver") from None

import plan
import report
from summary import summarize

DRIVER = Path("/usr/bin/chromedriver")
if not DRIVER.exists():
    raise unittest.SkipTest(f"no {DRIVER}: apt install chromium-driver")

CONFIGURATIONS = [c.name for c in plan.configurations(cross=False)]


COLORS = [{"difference": d, "color": c} for d, c in ((-0.25, (0, 0, 1)), (0, (1, 1, 1)), (0.25, (1, 0, 0)))]


def picture(level):
    """A PNG of 16 x 9 grey pixels as a data URL."""
    png = io.BytesIO()
    image_file.imsave(png, numpy.full((9, 16, 3), float(level)), format="png")
    return "data:image/png;base64," + base64.b64encode(png.getvalue()).decode()


ENDS_BETWEEN, ENDS_UNMEASURED = 2, 4  # configurations whose runs end each elsewhere, or with an error that the reference's hides


def rendering(scene, index, seed):
    points = [{"spp": n, "seconds": 0.1 * n, "cpu_seconds": 0.2 * n, "rmse": 0.1, "relmse": (1 + index / 10 + seed / 50) / n}
              for n in (1, 2, 4, 8, 16)]
    if index == ENDS_BETWEEN:
        n = 18 + seed
        points.append({**points[-1], "spp": n, "seconds": 0.1 * n, "cpu_seconds": 0.2 * n, "relmse": points[-1]["relmse"] * 16 / n})
    if index == ENDS_UNMEASURED and seed == 1:
        points[-1]["relmse"] = 1e-5  # of a reference with 1e-4
    figures = {"error_curve": points, "camera_samples_per_second": 1e6}
    if seed == 1:
        figures["views"] = {"picture": picture(index / 20), "difference": picture(1 - index / 20), "flip": 0.1, "colors": COLORS,
                            "statistical": {"different": index == 3}}
    return {"scene": scene, "configuration": CONFIGURATIONS[index], "seed": seed, "figures": figures}


PEER = "Mitsuba 3"


def made_up_results(scenes=("veach-mis", "a <b> & c")):
    interval = {"value": 1e-4, "low": 9e-5, "high": 1.1e-4}
    effort = type("Effort", (), {"seconds": 1.6})
    renderings = [rendering(scene, i, seed) for seed in (1, 2, 3) for scene in scenes for i in range(len(CONFIGURATIONS))]
    renderings += [{**rendering(scene, 3, seed), "configuration": PEER, "peer": True} for seed in (1, 2, 3) for scene in scenes]
    stats = {"model": "Lambert", "width": 16, "height": 9, "spp": 4096, "integrator": "mis", "lights": "tree", "seed": 9,
             "estimated_error": {"relmse": interval}}
    total = {"rays": 10, "decided": 9, "wrong": 0, "missed": 1, "wrong_occlusion": 0}
    rays = {"grid_rays_per_s": 2e6, "embree_rays_per_s": 1e6, "ratio": 2}
    references = {scene: {"picture": picture(0.5), "stats": stats} for scene in scenes}
    return {
        "machine": {"processor": "P", "threads": 2, "memory_gb": 4, "system": "S"}, "version": "lemma 0", "commit": "c", "libraries": ["libembree9.so"],
        "date": "2026-01-02",
        "relative_to": plan.DEFAULT, "effort": {"seconds": 1.6, "seeds": 3, "size": "16x9"},
        "references": references,
        "renderings": renderings, "summary": summarize(renderings, references, effort, plan.DEFAULT),
        "parity": [{"scene": "veach-mis", "accelerators": [{"accel": "embree", "total": total}]}],
        "traversal": {"cases": [{"case": "teapot", "trace": {"primary": rays, "bounce": rays}}]},
        "hard_cases": [{"case": "edges", "backend": "grid", "expected": "a hit", "tried": 5, "faults": 0, "allowed": "0"}],
        "peers": [{"scene": "veach-mis", "peer": "mitsuba 9", "spp": 1024, "relmse": 0.01,
                   "statistical": {"different": True, "global_z": [0.1, -9, 2], "global_limit": 3.76, "block_alarms": 2,
                                   "block_tests": 9, "block_limit": 4.9, "worst_block": {"z": 6}}}],
    }


class ReportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="lemma-report-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.page = report.write_report(made_up_results(), cls.folder)
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1000,900"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        cls.browser = webdriver.Chrome(service=Service(str(DRIVER)), options=options)
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        self.browser.set_window_size(1000, 900)
        self.browser.get(self.page.as_uri())

    def find(self, selector):
        return self.browser.find_elements("css selector", selector)

    def test_opens_without_errors_and_without_a_network(self):
        self.assertEqual(self.browser.get_log("browser"), [])
        loaded = self.browser.execute_script("return performance.getEntriesByType('resource').map(e => e.name)")
        self.assertEqual([name for name in loaded if not name.startswith("data:")], [])
        # Addresses are there only as names of XML's own vocabularies.
        outside = re.findall(r'(?:src|href)="(?!data:|#)([^"]*)"', self.page.read_text(encoding="utf-8"))
        self.assertEqual(outside, [])

    def test_plots_are_drawn(self):
        plots = self.find("figure svg")
        self.assertEqual(len(plots), 2 * 3 + 1)
        for plot in plots:
            self.assertGreater(plot.size["width"], 500)
            self.assertGreater(plot.size["height"], 50)
        for curve in range(len(CONFIGURATIONS) + 1):  # and the peer's
            lines = self.find(f"[id$='-curve-{curve}'] > path")  # without the markers
            self.assertEqual(len(lines), 4)
            for line in lines:
                box = self.browser.execute_script("const b = arguments[0].getBBox(); return [b.width, b.height]", line)
                self.assertGreater(min(box), 10, "a curve that goes down to the right")
        self.assertEqual({path.suffix for path in (self.folder / "plots").iterdir()}, {".svg", ".png"})
        self.assertTrue((self.folder / "errors.csv").read_text().startswith("scene,configuration,seed,spp,"))

    def test_ends_of_runs_that_no_curve_holds(self):
        """An open point where each run ends with a number of samples of its own; none where all end alike."""
        self.assertEqual(len(self.find(f"[id$='-end-{ENDS_BETWEEN}']")), 4)
        self.assertEqual(len(self.find("[id*='-end-']")), 4 + 4, "and of the runs of which one ends with no measurement")

    def test_efficiencies_of_an_earlier_point_are_marked(self):
        name = CONFIGURATIONS[ENDS_UNMEASURED]
        marked = [cell.text for cell in self.find("td:first-child") if cell.text.endswith(report.MARK)]
        self.assertEqual(marked, 2 * [name + report.MARK])
        self.assertEqual(len(self.find(".early")), 2)
        self.assertIn(f"{name} (1 of 3 runs).", self.find(".early")[0].text)

    def shown(self, viewer):
        """Caption, and addresses of the images below and above."""
        images = [image.get_attribute("src") for image in viewer.find_elements("css selector", ".stage img")]
        return viewer.find_element("css selector", ".caption").text, *images

    def test_viewer_answers_clicks_and_keys(self):
        viewer = self.find(".viewer")[0]
        stage = viewer.find_element("css selector", ".stage")
        widths = self.browser.execute_script(
            "return [...document.querySelectorAll('.stage img')].map(i => i.naturalWidth)")
        self.assertEqual(set(widths), {16}, "all images are loaded")
        caption, under, over = self.shown(viewer)
        self.assertEqual((caption, under), ("default | reference", picture(0.5)))
        self.assertEqual(stage.get_attribute("aria-label"), caption, "for those who do not see the images")
        stage.click()
        self.assertEqual(self.shown(viewer)[0], "reference")
        stage.click()
        self.assertEqual(self.shown(viewer)[0], "default")
        stage.send_keys(Keys.SPACE)
        self.assertEqual(self.shown(viewer)[0], "reference")
        stage.send_keys(Keys.ENTER)
        stage.send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(self.shown(viewer)[0], CONFIGURATIONS[1])
        stage.send_keys(Keys.ARROW_LEFT, "E")  # as with the shift key
        told = "default: signed error, too dark is blue, too bright is red"
        self.assertEqual(self.shown(viewer), (told, report.BLANK, picture(1)))  # nothing where the reference is
        self.assertNotEqual(self.shown(viewer)[2], over)
        self.assertEqual(self.browser.get_log("browser"), [])

    def test_slider_shows_a_part_of_each(self):
        viewer = self.find(".viewer")[0]
        self.browser.execute_script(
            "arguments[0].value = 30; arguments[0].dispatchEvent(new Event('input'))",
            viewer.find_element("css selector", "input[type=range]"))
        over = viewer.find_elements("css selector", ".stage img")[1]
        self.assertIn("70%", over.value_of_css_property("clip-path"))

    def test_fits_a_phone(self):
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": 390, "height": 800, "deviceScaleFactor": 2, "mobile": True})
        self.addCleanup(self.browser.execute_cdp_cmd, "Emulation.clearDeviceMetricsOverride", {})
        self.browser.get(self.page.as_uri())
        self.assertLessEqual(self.browser.execute_script("return document.documentElement.scrollWidth"), 390)
        smallest = self.browser.execute_script(
            "return Math.min(...[...document.querySelectorAll('figure svg text')].map(e => e.getBoundingClientRect().height))")
        self.assertGreaterEqual(smallest, 8, "pixels: the plots' text can be read")

    def test_signed_errors_share_a_scale(self):
        """A bar beside the viewer, from the first colour to the last, with numbers."""
        bars = self.find(".viewer .colors")
        self.assertEqual(len(bars), 2)
        self.assertEqual(bars[0].text.split(), ["-0.25", "+0.25"])
        colors = bars[0].find_element("css selector", "i").value_of_css_property("background-image")
        self.assertEqual(colors, "linear-gradient(to right, rgb(0, 0, 255), rgb(255, 255, 255), rgb(255, 0, 0))")

    def test_times_that_nobody_reached_have_a_dash(self):
        head, row = (self.find("table")[1].find_elements("css selector", selector) for selector in ("th", "tbody tr:first-child td"))
        cells = {h.text: d.text for h, d in zip(head, row)}
        self.assertEqual(cells["relMSE at 60 s"], "-")
        self.assertNotEqual(cells["relMSE at 1 s"], "-")

    def test_names_of_scenes_are_text(self):
        self.assertIn("a <b> & c", [heading.text for heading in self.find("h2")])

    def test_verdicts(self):
        cells = [cell.text for cell in self.find("td.bad")]
        self.assertEqual(cells.count("different"), 4 + 1)  # of both scenes' fourth configuration and the peer; of the peer's table
        self.assertIn("1 faults", cells)
        self.assertEqual([p.text for p in self.find("p.verdict")], 2 * ["The default is the most efficient, by CPU time."])

    def test_few_samples_have_no_verdict(self):
        views = {"statistical": {"different": True}}
        self.assertEqual(report.mean_verdict({"views": views, "viewed_spp": 15}), "too few samples: 15")
        self.assertEqual(report.mean_verdict({"views": views, "viewed_spp": 16}), ("different", "bad"))
        self.assertEqual(report.mean_verdict({"views": None, "viewed_spp": None}), "-")

    def test_printed_page(self):
        """A sheet of paper shows all images with their signed errors, no controls, and nothing is cut off at its edge."""
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",  # A4 without margins of 1 cm, at 96 dots an inch
                                     {"width": 718, "height": 1047, "deviceScaleFactor": 1, "mobile": False})
        self.addCleanup(self.browser.execute_cdp_cmd, "Emulation.clearDeviceMetricsOverride", {})
        self.addCleanup(self.browser.execute_cdp_cmd, "Emulation.setEmulatedMedia", {"media": ""})
        self.assertEqual([c.is_displayed() for c in self.find(".controls, nav")], 3 * [False])
        self.assertEqual([stage.is_displayed() for stage in self.find(".stage")], 2 * [False])
        galleries = self.find(".gallery")
        for gallery in galleries:
            captions = [caption.text for caption in gallery.find_elements("css selector", "figcaption")]
            self.assertEqual(captions, ["reference", *CONFIGURATIONS, PEER])
            images = gallery.find_elements("css selector", "img")
            self.assertEqual([image.is_displayed() for image in images], 2 * len(captions) * [True])
            self.assertEqual(images[3].get_attribute("src"), picture(1))
            self.assertEqual(images[3].get_attribute("alt"), "default: signed error")
        self.assertEqual(len(galleries), 2)
        widest = self.browser.execute_script(
            "return Math.max(...[...document.querySelectorAll('table, svg, .gallery img')].map(e => e.getBoundingClientRect().right))")
        self.assertLessEqual(widest, 718)


if __name__ == "__main__":
    unittest.main()
