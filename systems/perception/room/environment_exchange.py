"""The XML step between perception and planning as a system."""

from collections.abc import Callable

from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.values.room import Environment
from footfall.systems.perception.room.environment_xml import (
    read_environment,
    write_environment,
)
from footfall.systems.ports import eval_abstract
from footfall.systems.timing import timed


class EnvironmentExchange(LeafSystem):
    """Hands the environment on as XML, as perception does to planning (paper, Fig. 4).

    .. pydrake_system::

        name: EnvironmentExchange
        input_ports:
        - environment
        output_ports:
        - xml
        - environment

    - `environment` (input): what perception found, in W, Environment.
    - `xml`: the same as an XML document, str; see `environment_xml` for its schema.
    - `environment` (output): what that document says, in W, Environment; equal to the
      input bit for bit.
    """

    def __init__(self) -> None:
        """Declares the ports."""
        super().__init__()
        self._environment = self.DeclareAbstractInputPort(
            "environment", AbstractValue.Make(Environment())
        )
        calc_xml: Callable[..., None] = timed(self, self._calc_xml)
        calc_environment: Callable[..., None] = timed(self, self._calc_environment)
        self._xml = self.DeclareAbstractOutputPort(
            "xml",
            lambda: AbstractValue.Make(""),
            calc_xml,
            prerequisites_of_calc={self._environment.ticket()},
        )
        self.DeclareAbstractOutputPort(
            "environment",
            lambda: AbstractValue.Make(Environment()),
            calc_environment,
            prerequisites_of_calc={self._environment.ticket()},
        )

    def _calc_xml(self, context: Context, xml: AbstractValue) -> None:
        environment = eval_abstract(self._environment, context, Environment)
        xml.set_value(write_environment(environment))

    def _calc_environment(self, context: Context, environment: AbstractValue) -> None:
        document = eval_abstract(self._xml, context, str)
        environment.set_value(read_environment(document))
