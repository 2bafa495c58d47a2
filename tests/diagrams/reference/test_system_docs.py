"""What a docstring tells of a System, taken apart."""

import pytest
from pydrake.systems.framework import LeafSystem

from footfall.diagrams.reference.system_docs import (
    documented_ports,
    find_systems,
    system_doc,
)


class Sum(LeafSystem):
    """Adds two numbers.

    It forgets nothing:

    - neither this,
    - nor `that`: an item that is no port.

    .. pydrake_system::

        name: Sum
        input_ports:
        - a
        - b
        output_ports:
        - sum

    - `a`, `b`: what is added, (1,),
      m.
    - `sum`: a + b, (1,), m.
    """


class Silent(LeafSystem):
    """Says nothing of its ports."""


def test_a_docstring_is_taken_apart() -> None:
    """Summary, text without ports, and every port with its meaning on one line."""
    doc = system_doc(Sum)
    assert (doc.name, doc.summary) == ("Sum", "Adds two numbers.")
    assert (doc.inputs, doc.outputs) == (("a", "b"), ("sum",))
    added = "what is added, (1,), m."
    assert doc.ports == {"a": added, "b": added, "sum": "a + b, (1,), m."}
    assert "nor `that`: an item that is no port." in doc.text
    assert "pydrake_system" not in doc.text
    assert "`sum`" not in doc.text


def test_one_that_names_no_ports_is_told() -> None:
    """By its name."""
    with pytest.raises(ValueError, match="Silent has no pydrake_system block"):
        documented_ports(Silent)


@pytest.mark.parametrize("system", find_systems(), ids=lambda s: s.__qualname__)
def test_every_port_of_ours_has_a_meaning(system: type[LeafSystem]) -> None:
    """So that a page can say what it carries."""
    doc = system_doc(system)
    assert set(doc.ports) == {*doc.inputs, *doc.outputs}
    assert doc.summary.endswith(".")
