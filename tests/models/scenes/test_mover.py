"""Boxes that move: where they stand, that their servos hold and move them."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.multibody.plant import AddMultibodyPlant, MultibodyPlantConfig
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import ConstantVectorSource

from footfall.models.scenes.mover import MoverParams, add_movers

TROLLEY = MoverParams(name="trolley", x=0.5, y=-1.0, yaw=0.3, size=[0.5, 0.4, 0.6])
CART = MoverParams(name="cart", x=-2.0, y=0.25, size=[0.3, 0.3, 0.3])


def test_servos_take_the_boxes_to_where_they_are_to_be() -> None:
    """From their places, upright and turned as asked, in the order they are given."""
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlant(MultibodyPlantConfig(), builder)
    movers = add_movers(plant, [TROLLEY, CART])
    plant.Finalize()
    wanted = builder.AddSystem(
        ConstantVectorSource([1.0, 0.5, -2.0, 0.25, 0.0, 0.0, 0.0, 0.0])
    )
    builder.Connect(
        wanted.get_output_port(), plant.get_desired_state_input_port(movers)
    )
    simulator = Simulator(builder.Build())
    context = plant.GetMyContextFromRoot(simulator.get_context())
    np.testing.assert_array_equal(
        plant.GetPositions(context, movers), [0.5, -1.0, -2.0, 0.25]
    )
    simulator.AdvanceTo(1.5)
    np.testing.assert_allclose(
        plant.GetPositions(context, movers), [1.0, 0.5, -2.0, 0.25], atol=2e-3
    )
    inspector = scene_graph.model_inspector()
    body = plant.GetBodyByName("mover_trolley")
    (geometry,) = plant.GetCollisionGeometriesForBody(body)
    assert inspector.GetName(geometry).endswith("box/trolley")
    np.testing.assert_array_equal(inspector.GetShape(geometry).size(), TROLLEY.size)
    X_WG = plant.EvalBodyPoseInWorld(context, body).multiply(
        inspector.GetPoseInFrame(geometry)
    )
    np.testing.assert_allclose(X_WG.translation(), [1.0, 0.5, 0.301], atol=2e-3)
    assert X_WG.rotation().ToRollPitchYaw().yaw_angle() == pytest.approx(0.3)


def test_no_boxes_are_fine() -> None:
    """A room in which nothing moves."""
    plant, _ = AddMultibodyPlant(MultibodyPlantConfig(), DiagramBuilder())
    movers = add_movers(plant, [])
    plant.Finalize()
    assert plant.num_positions(movers) == 0


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("time", -1.0),
        ("duration", 0.0),
        ("to_x", np.nan),
        ("to_y", np.inf),
        ("x", np.nan),
    ],
)
def test_wrong_parameters_are_named(field: str, value: float) -> None:
    """The message begins with the field."""
    with pytest.raises(ValueError, match=f"^{field}: "):
        replace(TROLLEY, **{field: value}).validate()
