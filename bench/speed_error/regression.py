"""Comparison of two runs by ratio: on the same machine, is any configuration less efficient than it was?"""

ALLOWED = 0.8  # ratio to the baseline that noise and the weather of the machine may explain
REGRESSED = 3  # exit code, as that of lemma when a comparison fails


def worsened(summary, baseline):
    """(scene, configuration, ratio) of all that both have, and those whose ratio's interval ends below what is allowed."""
    rows, bad = [], []
    for scene, configurations in summary.items():
        for name, figures in configurations.items():
            before = baseline.get(scene, {}).get(name)
            if before is None:
                continue
            now, then = figures["efficiency"], before["efficiency"]
            row = (scene, name, now["value"] / then["value"])
            rows.append(row)
            if (now["high"] or now["value"]) / (then["low"] or then["value"]) < ALLOWED:
                bad.append(row)
    return rows, bad


def compare_with_baseline(summary, baseline):
    rows, bad = worsened(summary, baseline)
    print(f"{'scene':<20}{'configuration':<28}{'efficiency, ratio to baseline':>30}")
    for scene, name, ratio in rows:
        print(f"{scene:<20}{name:<28}{ratio:>30.3f}{'  worse' if (scene, name, ratio) in bad else ''}")
    return REGRESSED if bad else 0
