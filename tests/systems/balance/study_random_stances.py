"""Random stances: the default method against linear programmes, counted and printed.

Run with `python -m tests.systems.balance.study_random_stances [COUNT]`; 2000 take a
minute. `test_stability_polygon.py` holds a smaller number of the same.

Result for 2000 stances of one to four contacts at up to 40 deg: 1861 ok, 134
infeasible, 4 degenerate, 1 unbounded; 7 results of double description refused by the
check; no status differs; largest difference 7.7e-10 m.
"""

import sys
from collections import Counter

import numpy as np

from systems.balance.convex_polygon import hausdorff_distance
from systems.balance.stability_polygon import static_polygon
from tests.systems.balance.conftest import _random_stance


def main(count: int) -> None:
    """Prints the worst difference, and what the check caught."""
    rng = np.random.default_rng(2026)
    worst, caught, apart = 0.0, 0, 0
    statuses: Counter[str] = Counter()
    for _ in range(count):
        contacts = _random_stance(rng)
        ours = static_polygon(contacts)
        by_lp = static_polygon(contacts, "projection")
        worst = max(worst, hausdorff_distance(ours.vertices, by_lp.vertices))
        apart += ours.status != by_lp.status
        caught += ours.caught
        statuses[ours.status] += 1
    print(f"{count} stances: {dict(statuses)}")
    print(f"double description refused by the check: {caught}")
    print(f"statuses that differ from the linear programmes': {apart}")
    print(f"largest difference: {worst:.1e} m")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2000)
