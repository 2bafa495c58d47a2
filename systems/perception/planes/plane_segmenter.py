"""The plane segmentation as a system."""

from pydrake.common.value import AbstractValue
from pydrake.perception import PointCloud
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.robots.robot import Sole
from footfall.models.values.perceived import PlaneSegmentation
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.cut_sweep import CutCloud, empty_cut
from footfall.systems.perception.planes.plane_segmentation import (
    is_cut_for,
    segment_planes,
)
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.ports import eval_abstract, eval_vector
from footfall.systems.timing import timed


class PlaneSegmenter(LeafSystem):
    """Finds the plane segments of a cloud and the staircase among them.

    Stair paper (Zhang, Caron, Nakamura 2016), Sec. 4. The result is a cached output:
    it is computed when the cloud, gravity or viewpoint changed and someone asks.

    .. pydrake_system::

        name: PlaneSegmenter
        input_ports:
        - cloud
        - gravity
        - viewpoint
        - cut_cloud
        output_ports:
        - segmentation

    - `cloud`: pydrake PointCloud in W, m; points that are not finite are left out.
    - `gravity`: gravity in W, (3,), any length: it points down. The paper takes it from
      the acceleration sensor; our closed loop gives a constant.
    - `viewpoint`: p_WSensor, (3,), m, where the cloud was seen from; need not be
      connected, but then normals are turned up, so that a ceiling is a plane too.
    - `cut_cloud`: the same cloud where it was cut line by line as it came, CutCloud in
      W; need not be connected. Where it fits the parameters and gravity it stands for
      the cloud; a subclass with a `segment` of its own does without it.
    - `segmentation`: PlaneSegmentation in W; empty where the cloud is.
    """

    def __init__(self, sole: Sole, params: PlaneSegmenterParams | None = None) -> None:
        """Declares the ports.

        Args:
            sole: of the robot; what is smaller is no plane to stand on.
            params: parameters; None for the paper's.

        Raises:
            ValueError: a parameter makes no sense.
        """
        super().__init__()
        self.params = params or PlaneSegmenterParams()
        """What it was made with."""
        self.params.validate()
        self._sole = sole
        self._cloud = self.DeclareAbstractInputPort(
            "cloud", AbstractValue.Make(PointCloud(0))
        )
        self._gravity = self.DeclareVectorInputPort("gravity", 3)
        self._viewpoint = self.DeclareVectorInputPort("viewpoint", 3)
        self._cut = self.DeclareAbstractInputPort(
            "cut_cloud", AbstractValue.Make(empty_cut(1.0))
        )
        self.DeclareAbstractOutputPort(
            "segmentation",
            lambda: AbstractValue.Make(PlaneSegmentation()),
            timed(self, self._calc_segmentation),  # type: ignore[arg-type]
            prerequisites_of_calc={
                self._cloud.ticket(),
                self._gravity.ticket(),
                self._viewpoint.ticket(),
                self._cut.ticket(),
            },
        )

    def _calc_segmentation(self, context: Context, segmentation: AbstractValue) -> None:
        gravity = eval_vector(self._gravity, context)
        viewpoint = (
            eval_vector(self._viewpoint, context)
            if self._viewpoint.HasValue(context)
            else None
        )
        cut = self._fitting_cut(context, gravity)
        if cut is not None and viewpoint is not None:
            found, _ = segment_planes(
                cut.points, gravity, self.params, self._sole, viewpoint, cut
            )
            segmentation.set_value(found)
            return
        cloud = eval_abstract(self._cloud, context, PointCloud)
        points: Vector = cloud.xyzs().T.astype(float)
        segmentation.set_value(self.segment(points, gravity, viewpoint))

    def _fitting_cut(self, context: Context, gravity: Vector) -> CutCloud | None:
        """Gives the cut cloud; None where it does not serve or is not asked for."""
        own_way = type(self).segment is not PlaneSegmenter.segment
        if own_way or not self._cut.HasValue(context):
            return None
        cut = eval_abstract(self._cut, context, CutCloud)
        return cut if is_cut_for(cut, gravity, self.params) else None

    def segment(
        self, points: Vector, gravity: Vector, viewpoint: Vector | None
    ) -> PlaneSegmentation:
        """Segments a cloud; a subclass may do it its own way.

        Args:
            points: the cloud in W, (n, 3), m; not all need be finite.
            gravity: gravity in W, (3,), any length: it points down.
            viewpoint: p_WSensor, (3,), m, None where it is unknown.
        """
        return segment_planes(points, gravity, self.params, self._sole, viewpoint)[0]
