"""A stand-in for the ZED SDK's Python module, for tests without SDK, GPU and camera: the parts that
examples/zed_camera.py uses.

Written to the published interface of pyzed 5 (https://github.com/stereolabs/zed-python-api): the same names in the
same order, with the same defaults, and as strict: arguments of another type, unknown names and unknown attributes
are errors. The environment sets the camera's answers: STANDIN_OPEN and STANDIN_TRACKING are names of codes,
STANDIN_GRABS lists those of successive grabs, after which the camera is disconnected.
"""
import enum
import os
import time

import numpy as np


class _Ordered(enum.Enum):
    def __lt__(self, other):
        return self.value < other.value if isinstance(other, type(self)) else NotImplemented

    def __le__(self, other):
        return self.value <= other.value if isinstance(other, type(self)) else NotImplemented

    def __repr__(self):
        return self.name.replace("_", " ")


# Warnings are below SUCCESS, failures above.
ERROR_CODE = _Ordered(
    "ERROR_CODE",
    {
        **{"SENSOR_CONFIGURATION_CHANGED": -6, "POTENTIAL_CALIBRATION_ISSUE": -5, "CONFIGURATION_FALLBACK": -4},
        **{"SENSORS_DATA_REQUIRED": -3, "CORRUPTED_FRAME": -2, "CAMERA_REBOOTING": -1, "SUCCESS": 0, "FAILURE": 1},
        **{"NO_GPU_COMPATIBLE": 2, "NOT_ENOUGH_GPU_MEMORY": 3, "CAMERA_NOT_DETECTED": 4, "SENSORS_NOT_AVAILABLE": 6},
        **{"INVALID_RESOLUTION": 7, "INVALID_FUNCTION_PARAMETERS": 17, "CAMERA_NOT_INITIALIZED": 19},
        **{"INVALID_FUNCTION_CALL": 21},
    },
)
RESOLUTION = _Ordered("RESOLUTION", "HD4K QHDPLUS HD2K HD1080 HD1200 HD1536 HD720 SVGA VGA AUTO")
DEPTH_MODE = _Ordered("DEPTH_MODE", "NONE PERFORMANCE QUALITY ULTRA NEURAL_LIGHT NEURAL NEURAL_PLUS")
UNIT = _Ordered("UNIT", "MILLIMETER CENTIMETER METER INCH FOOT")
COORDINATE_SYSTEM = _Ordered(
    "COORDINATE_SYSTEM",
    "IMAGE LEFT_HANDED_Y_UP RIGHT_HANDED_Y_UP RIGHT_HANDED_Z_UP LEFT_HANDED_Z_UP RIGHT_HANDED_Z_UP_X_FWD",
)
FLIP_MODE = _Ordered("FLIP_MODE", "OFF ON AUTO")
REFERENCE_FRAME = _Ordered("REFERENCE_FRAME", "WORLD CAMERA")
TIME_REFERENCE = _Ordered("TIME_REFERENCE", "IMAGE CURRENT")
MEASURE = _Ordered("MEASURE", "DISPARITY DEPTH CONFIDENCE XYZ XYZRGBA XYZBGRA XYZARGB XYZABGR NORMALS DEPTH_U16_MM")
MEM = enum.Enum("MEM", "CPU GPU BOTH")
POSITIONAL_TRACKING_STATE = _Ordered(
    "POSITIONAL_TRACKING_STATE", "SEARCHING OK OFF FPS_TOO_LOW SEARCHING_FLOOR_PLANE UNAVAILABLE"
)

# The rectified left camera at full size, 1920 × 1080; the age of the stamps; its pose in the world.
FOCAL, CENTRE_X, CENTRE_Y = 1000.0, 960.0, 540.0
AGE_NS = 40_000_000
POSITION, ORIENTATION = (1.0, 2.0, 3.0), (0.0, 0.6, 0.0, 0.8)
# The depth of a pixel, by column: known depth, unknown, too near, too far.
DEPTHS = (2.0, np.nan, -np.inf, np.inf)


def _expect(value, kind):
    # In Python, a bool is an int, and the module's own checks agree.
    if not isinstance(value, kind):
        raise TypeError(f"{value!r} is no {kind.__name__}")
    return value


class _Checked:
    """Attributes of given types and no others."""

    __slots__ = ("_values",)
    _fields = {}

    def __init__(self, *args, **kwargs):
        names = list(self._fields)
        if len(args) > len(names):
            raise TypeError("too many arguments")
        given = {**dict(zip(names, args)), **kwargs}
        object.__setattr__(self, "_values", {})
        for name, (_, default) in self._fields.items():
            setattr(self, name, given.pop(name, default))
        if given:
            raise TypeError(f"unexpected keyword argument {next(iter(given))}")

    def __getattr__(self, name):
        if name not in self._fields:
            raise AttributeError(name)
        return self._values[name]

    def __setattr__(self, name, value):
        if name not in self._fields:
            raise AttributeError(name)
        self._values[name] = _expect(value, self._fields[name][0])


class InitParameters(_Checked):
    _fields = {
        "camera_resolution": (RESOLUTION, RESOLUTION.AUTO),
        "camera_fps": (int, 0),
        "svo_real_time_mode": (bool, False),
        "depth_mode": (DEPTH_MODE, DEPTH_MODE.NEURAL),
        "coordinate_units": (UNIT, UNIT.MILLIMETER),
        "coordinate_system": (COORDINATE_SYSTEM, COORDINATE_SYSTEM.IMAGE),
        "camera_image_flip": (FLIP_MODE, FLIP_MODE.OFF),
    }


class RuntimeParameters(_Checked):
    _fields = {
        "enable_depth": (bool, True),
        "enable_fill_mode": (bool, False),
        "confidence_threshold": (int, 95),
        "texture_confidence_threshold": (int, 100),
        "measure3D_reference_frame": (REFERENCE_FRAME, REFERENCE_FRAME.CAMERA),
        "remove_saturated_areas": (bool, True),
    }


class PositionalTrackingParameters:
    __slots__ = ()


class Resolution(_Checked):
    _fields = {"width": (int, 0), "height": (int, 0)}


class Timestamp:
    __slots__ = ("_ns",)

    def __init__(self):
        self._ns = 0

    def get_nanoseconds(self):
        return self._ns


class _Vector:
    __slots__ = ("_values",)

    def __init__(self):
        self._values = ()

    def get(self):
        return np.array(self._values)


class Translation(_Vector):
    __slots__ = ()


class Orientation(_Vector):
    __slots__ = ()


class Pose:
    __slots__ = ("_known",)

    def __init__(self):
        self._known = False

    # One object for all calls without an argument, as in the original.
    def get_translation(self, py_translation=Translation()):
        py_translation._values = POSITION if self._known else (0.0, 0.0, 0.0)
        return py_translation

    def get_orientation(self, py_orientation=Orientation()):
        py_orientation._values = ORIENTATION if self._known else (0.0, 0.0, 0.0, 1.0)
        return py_orientation


class Mat:
    __slots__ = ("_data",)

    def __init__(self):
        self._data = np.zeros((0, 0), np.float32)

    def get_data(self, memory_type=MEM.CPU, deep_copy=False):
        """A view of memory that the next picture overwrites."""
        if _expect(memory_type, MEM) != MEM.CPU:
            raise ValueError("not in that memory")
        return self._data.copy() if deep_copy else self._data


class CameraParameters:
    __slots__ = ("fx", "fy", "cx", "cy")


class _Named:
    """An attribute by a name."""

    __slots__ = ("_name", "_value")

    def __init__(self, name, value):
        self._name, self._value = name, value

    def __getattr__(self, name):
        if name != self._name:
            raise AttributeError(name)
        return self._value


class Camera:
    __slots__ = ("_open", "_tracks", "_grabs", "_frame")

    def __init__(self):
        self._open, self._tracks, self._frame = None, False, 0
        self._grabs = iter(os.environ.get("STANDIN_GRABS", "SUCCESS").split(","))

    def open(self, py_init=None):
        self._open = _expect(py_init, InitParameters)
        return ERROR_CODE[os.environ.get("STANDIN_OPEN", "SUCCESS")]

    def enable_positional_tracking(self, py_tracking=None):
        _expect(py_tracking, PositionalTrackingParameters)
        status = ERROR_CODE[os.environ.get("STANDIN_TRACKING", "SUCCESS")]
        self._tracks = status <= ERROR_CODE.SUCCESS
        return status

    def get_camera_information(self, resizer=None):
        size = _expect(resizer, Resolution)
        left = CameraParameters()
        across, down = size.width / 1920, size.height / 1080
        left.fx, left.fy, left.cx, left.cy = FOCAL * across, FOCAL * down, CENTRE_X * across, CENTRE_Y * down
        calibration = _Named("calibration_parameters", _Named("left_cam", left))
        return _Named("camera_configuration", calibration)

    def grab(self, py_runtime=None):
        _expect(py_runtime, RuntimeParameters)
        if self._open is None:
            return ERROR_CODE.CAMERA_NOT_INITIALIZED
        status = ERROR_CODE[next(self._grabs, "CAMERA_NOT_DETECTED")]
        self._frame += 1
        return status

    def get_timestamp(self, time_reference):
        stamp = Timestamp()
        stamp._ns = time.time_ns()
        if _expect(time_reference, TIME_REFERENCE) == TIME_REFERENCE.IMAGE:
            stamp._ns -= AGE_NS
        return stamp

    def retrieve_measure(self, py_mat, measure=MEASURE.DEPTH, mem_type=MEM.CPU, resolution=None):
        _expect(py_mat, Mat)
        size = _expect(resolution, Resolution)
        if _expect(measure, MEASURE) != MEASURE.XYZRGBA or _expect(mem_type, MEM) != MEM.CPU:
            return ERROR_CODE.INVALID_FUNCTION_PARAMETERS
        if size.width > 1920 or size.height > 1080:
            return ERROR_CODE.INVALID_RESOLUTION
        if py_mat._data.shape != (size.height, size.width, 4):
            py_mat._data = np.empty((size.height, size.width, 4), np.float32)
        self._draw(py_mat._data)
        return ERROR_CODE.SUCCESS

    def get_position(self, py_pose, reference_frame=REFERENCE_FRAME.WORLD):
        _expect(reference_frame, REFERENCE_FRAME)
        _expect(py_pose, Pose)._known = self._tracks
        return POSITIONAL_TRACKING_STATE.OK if self._tracks else POSITIONAL_TRACKING_STATE.OFF

    def _draw(self, cloud):
        """A wall perpendicular to the line of sight, in the requested units and axes; the blue of its colour is the
        frame.
        """
        height, width = cloud.shape[:2]
        metres = self._open.coordinate_units == UNIT.METER and self._open.coordinate_system == COORDINATE_SYSTEM.IMAGE
        depth = np.resize(np.array(DEPTHS, np.float32), width) * (1 if metres else 1000)
        columns, rows = np.meshgrid(np.arange(width), np.arange(height))
        with np.errstate(invalid="ignore"):
            cloud[..., 0] = (columns * 1920 / width - CENTRE_X) / FOCAL * depth
            cloud[..., 1] = (rows * 1080 / height - CENTRE_Y) / FOCAL * depth
        cloud[..., 2] = depth
        colour = np.stack([columns % 256, rows % 256, np.full_like(rows, self._frame), np.full_like(rows, 255)], axis=-1)
        cloud[..., 3] = np.ascontiguousarray(colour.astype(np.uint8)).view(np.float32)[..., 0]
