"""The part of a scenario that says how the systems do what the task asks."""

from dataclasses import dataclass, field

from footfall.models.values.validation import Parameters, number
from footfall.systems.balance.landing_adaptor import LandingParams
from footfall.systems.balance.stabilizer import StabilizerParams
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.estimation.com_observer import ComObserverParams
from footfall.systems.estimation.contact_detector import ContactParams
from footfall.systems.estimation.filter_params import FilterParams
from footfall.systems.perception.depth_cloud import DepthCloudParams
from footfall.systems.perception.obstacles.boxes import ObstacleClustererParams
from footfall.systems.perception.obstacles.obstacles import ObstacleFinderParams
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.room.floor import FloorParams
from footfall.systems.perception.scan_assembler import ScanAssemblerParams
from footfall.systems.perception.staircases.staircase_merging import StaircaseMapParams
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.executive.executive import ExecutiveParams
from footfall.systems.planning.executive.path_executive import PathExecutiveParams
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.path.path_params import PathPlannerParams
from footfall.systems.thinking import ThinkingParams
from footfall.systems.tracking.whole_body_ik import IkParams


@dataclass(kw_only=True)
class ControllerParams(Parameters):
    """The parameters of the systems: those that several share, then each one's own."""

    control_period: float = number(0.005, "s", least=1e-4, most=0.1)
    """Tick of the fast loop: from the sampling of plans to the hold of the torques, s;
    a multiple of `simulation.time_step`."""
    friction: float = number(0.6, above=0.0, most=10.0)
    """mu of the pyramids that planned and commanded contact wrenches are kept in;
    below the ground's, so that the feet do not slide."""
    com_height: float = number(0.85, "m", least=0.3, most=1.5)
    """CoM above the ground at mid-stance, and of the preview's cart, m. Higher
    stretches the knees, lower loads them: at 0.80 m level walking needs 100 Nm at the
    knee, at 0.85 m 60 Nm."""
    scan_assembler: ScanAssemblerParams = field(default_factory=ScanAssemblerParams)
    """From scan lines to a cloud."""
    segmenter: PlaneSegmenterParams = field(default_factory=PlaneSegmenterParams)
    """From the cloud to planes and the staircase."""
    staircase_map: StaircaseMapParams = field(default_factory=StaircaseMapParams)
    """What is remembered from scan to scan."""
    footstep_planner: FootstepPlannerParams = field(
        default_factory=FootstepPlannerParams
    )
    """Where the feet go."""
    motion_planner: MotionPlannerParams = field(default_factory=MotionPlannerParams)
    """When and how they go there."""
    zmp_preview: ZmpPreviewParams = field(
        default_factory=lambda: ZmpPreviewParams(preview_time=2.4)
    )
    """The cart-table's preview control. A plan comes into view all at once, at its
    start; with Kajita's 1.6 s what is beyond the preview then shifts the ZMP of the
    CoM's reference by 37 mm for a moment, with 2.4 s by 3 mm."""
    contact: ContactParams = field(default_factory=ContactParams)
    """When a foot counts as on the ground, and when it bears."""
    base_estimator: FilterParams = field(default_factory=FilterParams)
    """How far the filter of base and feet trusts the sensors."""
    com_observer: ComObserverParams = field(default_factory=ComObserverParams)
    """How fast the forces under the feet correct the model's CoM."""
    landing: LandingParams = field(default_factory=LandingParams)
    """How a foot lands."""
    stabilizer: StabilizerParams = field(default_factory=StabilizerParams)
    """Balance feedback."""
    ik: IkParams = field(default_factory=IkParams)
    """Whole-body tracking."""
    depth_cloud: DepthCloudParams = field(default_factory=DepthCloudParams)
    """From a depth image to a cloud."""
    floor: FloorParams = field(default_factory=FloorParams)
    """What counts as the floor."""
    obstacles: ObstacleClustererParams = field(default_factory=ObstacleClustererParams)
    """From the points above the floor to boxes."""
    path_planner: PathPlannerParams = field(default_factory=PathPlannerParams)
    """The way through the room."""
    path_executive: PathExecutiveParams = field(default_factory=PathExecutiveParams)
    """When to look, plan and walk in a room."""
    executive: ExecutiveParams = field(default_factory=ExecutiveParams)
    """When to scan, plan and move."""
    obstacle_finder: ObstacleFinderParams = field(default_factory=ObstacleFinderParams)
    """From the cloud to what lies in the way."""
    crossing: CrossingParams = field(default_factory=CrossingParams)
    """How that is stepped over."""
    thinking: ThinkingParams = field(default_factory=ThinkingParams)
    """How long perception and planning take."""
