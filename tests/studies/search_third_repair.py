"""Searches crossings in which the third repair of FTA acts, and writes what it did.

    python tests/studies/search_third_repair.py --count 1000 --out result.md

Obstacles of 2 to 16 cm by 3 to 30 cm, drawn at random, each in one of the ways of
crossing, are planned from Algorithm 1 up to FTA. The repair acts where the first two
leave the second leg in the obstacle's margins and yielding takes it less deep.
"""

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.values.feet import FEET
from footfall.models.values.obstacle import Obstacle
from footfall.models.values.planned import Footstep
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.crossing.feasibility_unit import feasibility_unit
from footfall.systems.planning.crossing.leg_clearance import Section
from footfall.systems.planning.crossing.motion import plan_crossing
from footfall.systems.planning.crossing.params import CrossingParams, ways_of_crossing
from footfall.systems.planning.crossing.report import CrossingReport
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.whole_body.whole_body_plan import (
    WholeBody,
    planning_body,
)

WAIST = 0.79
"""Height of the hips in walking, m."""
HALF = 0.095
"""Half the distance of the feet, m."""


def planned(
    section: Section, params: CrossingParams, body: WholeBody
) -> CrossingReport | None:
    """What is planned over an obstacle after two steps up to it; None where FU refuses.

    Args:
        section: the obstacle.
        params: way of crossing.
        body: the robot.
    """
    key = feasibility_unit(section, WAIST, body.leg, params.feasibility).key
    if key is None:
        return None
    walking = MotionPlannerParams()
    centre = np.array([0.2 + key.front + section.width / 2.0, 0.0])
    feet = np.zeros((2, 6))
    feet[:, 1] = HALF, -HALF
    steps = []
    for x, plane in ((0.2, -1), (0.2 + key.X_ads, 0), (0.3 + key.X_ads, -1)):
        for foot, y in zip(FEET, (HALF, -HALF), strict=True):
            steps.append(Footstep(foot, RigidTransform(np.array([x, y, 0.0])), plane))
    motion = plan_crossing(
        feet,
        np.array([walking.zmp_forward, 0.0, 0.83]),
        tuple(steps),
        (Obstacle(centre, 0.0, section.width, section.height, 1.0),),
        (key,),
        walking,
        replace(params, filter_stages=0),
        ZmpPreviewParams(),
        body,
        body.plant.CreateDefaultContext(),
    )
    return motion.report


def main() -> None:
    """Runs the study."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--out", type=Path, default=None)
    arguments = parser.parse_args()
    body = planning_body(JVRC1, robot_alone(JVRC1))
    ways = ways_of_crossing(CrossingParams())
    random = np.random.default_rng(arguments.seed)
    lines = [
        "| obstacle | way | shift [cm] | raised [cm] | path [cm] | gap [cm] | wanted |",
        "|---|---|---|---|---|---|---|",
    ]
    plans = acted = freed = 0
    for _ in range(arguments.count):
        section = Section(random.uniform(0.02, 0.16), random.uniform(0.03, 0.30))
        way = int(random.integers(len(ways)))
        report = planned(section, ways[way], body)
        if report is None:
            continue
        plans += 1
        repairs = report.repairs
        if not repairs.path.size:
            continue
        acted += 1
        freed += report.gap >= ways[way].min_gap
        lines.append(
            f"| {100 * section.height:.1f} x {100 * section.width:.1f} cm | {way} | "
            f"{100 * repairs.shift:.0f} | {100 * repairs.raised:.0f} | "
            f"{100 * repairs.path.min():.1f} | {100 * report.gap:.2f} | "
            f"{100 * ways[way].min_gap:.2f} |"
        )
    lines.append("")
    lines.append(
        f"{plans} plans of {arguments.count} obstacles: the third repair acts in "
        f"{acted}, and {freed} of these keep the distance that is wanted."
    )
    print("\n".join(lines))
    if arguments.out is not None:
        arguments.out.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
