"""Lines of `make bench`."""

from examples.bench_lines import milliseconds, report_at_most


def test_the_median_counts_and_a_limit_is_said(capsys):
    report_at_most("a slider", [10.0, 30.0, 80.0], "ms", 60.0)
    report_at_most("a slider", [10.0, 70.0, 80.0], "ms", 60.0)
    report_at_most("Apply", [10.0], "ms", None)
    first, second, third = capsys.readouterr().out.splitlines()
    assert first.split() == "a slider 30 (10 to 80) ms; must be 60: yes".split()
    assert second.endswith("must be 60: NO")
    assert third.split() == ["Apply", "10", "ms"]


def test_work_is_told_its_run():
    runs = []
    spent = milliseconds(runs.append, 3)
    assert runs == [0, 1, 2] and len(spent) == 3 and min(spent) >= 0.0
