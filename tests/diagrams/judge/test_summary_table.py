"""The summary on the terminal."""

from footfall.diagrams.judge.summary import Summary
from footfall.diagrams.judge.summary_table import print_summary


def test_nested_figures_are_rows_of_their_own(tmp_path, capsys) -> None:
    """Rounded, without braces; a list of one needs no number."""
    summary = Summary(
        scenario="x",
        outcome="completed",
        reason="done",
        seed=0,
        simulated_time_s=1.0,
        wall_time_s=2.0,
        real_time_factor=0.5,
        max_torque_fraction=0.98312,
        max_torque_joint="L_KNEE",
        torque_limit_s=0.125,
        torque_limit_joint="R_KNEE",
        crossing={
            "zmp_error_after_cwtg1_m": [0.075821234, 0.0190912],
            "planning_ms": 272.0,
            "keys": [{"X_ads": 0.4036644636, "X_end": None}],
            "repairs": [{"path": []}, {"path": [0.01]}],
        },
    )
    print_summary(summary, tmp_path)
    first, *table, last = capsys.readouterr().out.splitlines()
    assert (first, last) == ("completed: done", f"written to {tmp_path}")
    rows = dict(line.split(maxsplit=1) for line in table)
    rows = {name: value.strip() for name, value in rows.items()}
    assert rows["crossing.zmp_error_after_cwtg1_m"] == "0.07582, 0.01909"
    assert rows["crossing.planning_ms"] == "272"
    assert rows["max_torque_fraction"] == "0.9831 (L_KNEE)"
    assert rows["torque_limit_s"] == "0.125 (R_KNEE)"
    assert rows["climb_time_s"] == "not measured"
    assert not {"timing_us", "versions", "outcome"} & set(rows)
    assert rows["crossing.keys.X_ads"] == "0.4037"
    assert rows["crossing.keys.X_end"] == "not measured"
    assert rows["crossing.repairs[0].path"] == "none"
    assert rows["crossing.repairs[1].path"] == "0.01"
