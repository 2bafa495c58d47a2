"""Both ways of the cone against linear programmes on random stances, counted, printed.

Run with `python -m tests.systems.balance.study_random_stances [COUNT]`; 2000 take a
minute. `test_stability_polygon.py` holds a smaller number of the same.

Result for 2000 stances of one to four contacts at up to 40 deg: 1861 ok, 134
infeasible, 4 degenerate, 1 unbounded. The check refused 4 answers of the walk round
the section (all of segments and points) and 7 of double description; no status
differs; largest difference of either 7.7e-10 m.
"""

import sys
from collections import Counter

import numpy as np

from footfall.systems.balance.convex_polygon import hausdorff_distance
from footfall.systems.balance.stability_polygon import Method, static_polygon
from tests.systems.balance.conftest import _random_stance


def main(count: int) -> None:
    """Prints the worst differences, and what the check caught."""
    rng = np.random.default_rng(2026)
    methods: tuple[Method, ...] = ("section", "double_description")
    worst = dict.fromkeys(methods, 0.0)
    caught, apart = Counter[str](), Counter[str]()
    statuses: Counter[str] = Counter()
    for _ in range(count):
        contacts = _random_stance(rng)
        by_lp = static_polygon(contacts, "projection")
        statuses[by_lp.status] += 1
        for method in methods:
            ours = static_polygon(contacts, method)
            distance = hausdorff_distance(ours.vertices, by_lp.vertices)
            worst[method] = max(worst[method], distance)
            apart[method] += ours.status != by_lp.status
            caught[method] += ours.caught
    print(f"{count} stances: {dict(statuses)}")
    for method in methods:
        print(
            f"{method}: {caught[method]} refused by the check, {apart[method]} statuses"
            f" differ, largest difference {worst[method]:.1e} m"
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2000)
