"""The judge of a run: evidence, measures, rules, outcome and summary."""
