"""What is measured: scenes, sizes, and configurations of the renderer."""

import itertools
from dataclasses import dataclass

# For each option the values to compare; the first is the default of `lemma render` and part of the baseline.
DIMENSIONS = {
    "accel": ("embree", "grid"),
    "integrator": ("mis", "direct", "brdf", "mis-report"),
    "lights": ("tree", "projected", "solid-angle", "power", "radiance-area"),
    "mis": ("power", "balance"),
    "sampler": ("sobol", "independent"),
}
# The same for options that are compared with their default alone, never in combinations.
SINGLES = {
    "rr": ("throughput", "fixed"),
    "brdf-sampling": ("truncated", "p6"),
}
DEFAULT = "default"  # name of the baseline
BASELINE = tuple((name, values[0]) for name, values in DIMENSIONS.items())


@dataclass(frozen=True)
class Configuration:
    """Values of all dimensions, and of a single one that differs from its default."""

    options: tuple

    @property
    def name(self):
        """What differs from the baseline."""
        others = [f"{name} {value}" for name, value in self.options if (name, value) not in BASELINE]
        return ", ".join(others) or DEFAULT

    def arguments(self):
        return [word for name, value in self.options for word in (f"--{name}", value)]


def has_effect(options):
    """Whether no option is one that others make meaningless: light sampling without light samples, MIS without both."""
    chosen = dict(options)
    if chosen["integrator"] == "brdf" and chosen["lights"] != DIMENSIONS["lights"][0]:
        return False
    return chosen["integrator"] in ("mis", "mis-report") or chosen["mis"] == DIMENSIONS["mis"][0]


def configurations(cross):
    """The baseline first. Without `cross`, what differs from it in one dimension; with it, all combinations."""
    everything = itertools.product(*([(name, value) for value in values] for name, values in DIMENSIONS.items()))
    chosen = (options for options in everything
              if has_effect(options) and (cross or sum(o not in BASELINE for o in options) <= 1))
    singles = (BASELINE + ((name, value),) for name, values in SINGLES.items() for value in values[1:])
    return [Configuration(options) for options in itertools.chain(chosen, singles)]


@dataclass(frozen=True)
class Effort:
    """How much work a run of the benchmark is."""

    size: str  # of the images
    seconds: float  # of each rendering
    seeds: int
    reference_spp: int
    parity_rays: int
    traversal_cases: tuple  # of ./run bench-traversal, beside the scenes
    traversal_rounds: int
    peer_spp: int  # samples a pixel of other renderers' converged images

    def pixels(self):
        width, height = self.size.split("x")
        return int(width) * int(height)

    def reference_seconds(self):
        """Rough; as the two below, for the time that is left alone, which follows the pace of what was done."""
        return self.pixels() * self.reference_spp / 1e6

    def parity_seconds(self):
        return self.parity_rays / 2e4

    def traversal_seconds(self, scenes):
        return 1.5 * (len(self.traversal_cases) + scenes) * self.traversal_rounds


HARD_SECONDS = 60
RENDERINGS_A_RATE, RATE_SECONDS = 7, 0.3  # Embree's rate is measured before each so many renderings; what it takes
QUICK = Effort("128x72", 0.5, 5, 2048, 20000, ("veach-mis", "interior"), 3, 1024)
FULL = Effort("320x180", 60.0, 8, 16384, 1000000,
              ("veach-mis", "interior", "sphere-1M", "field-1M"), 7, 16384)
SCENES = ("veach-mis", "cornell-box", "cornell-coplanar")  # folders of scenes/
REFERENCE_SEED = 1000003
# The baseline's estimator, which has the least noise for its time; with variances of independent scramblings. A bias of it
# would show, as disagreement with every configuration that does not share it.
REFERENCE_REPLICATES = 16
REFERENCE = ["--replicates", str(REFERENCE_REPLICATES)]
