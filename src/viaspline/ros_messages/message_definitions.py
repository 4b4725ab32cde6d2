"""The definitions of the messages of ROS 2 that are written and read here, as texts.

They are the same from Humble on. Constants are left out: they are no part of a message's bytes nor
of its type's hash.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

DEFINITIONS: Mapping[str, str] = MappingProxyType(
    {
        "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec",
        "builtin_interfaces/msg/Duration": "int32 sec\nuint32 nanosec",
        "std_msgs/msg/Header": "builtin_interfaces/Time stamp\nstring frame_id",
        "std_msgs/msg/String": "string data",
        "std_msgs/msg/ColorRGBA": "float32 r\nfloat32 g\nfloat32 b\nfloat32 a",
        "geometry_msgs/msg/Vector3": "float64 x\nfloat64 y\nfloat64 z",
        "geometry_msgs/msg/Point": "float64 x\nfloat64 y\nfloat64 z",
        "geometry_msgs/msg/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
        "geometry_msgs/msg/Pose": (
            "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation"
        ),
        "geometry_msgs/msg/PoseStamped": "std_msgs/Header header\ngeometry_msgs/Pose pose",
        "geometry_msgs/msg/PoseWithCovariance": ("geometry_msgs/Pose pose\nfloat64[36] covariance"),
        "geometry_msgs/msg/PoseWithCovarianceStamped": (
            "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose"
        ),
        "geometry_msgs/msg/Twist": "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular",
        "geometry_msgs/msg/TwistStamped": "std_msgs/Header header\ngeometry_msgs/Twist twist",
        "geometry_msgs/msg/TwistWithCovariance": (
            "geometry_msgs/Twist twist\nfloat64[36] covariance"
        ),
        "geometry_msgs/msg/Transform": (
            "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation"
        ),
        "geometry_msgs/msg/TransformStamped": (
            "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform"
        ),
        "tf2_msgs/msg/TFMessage": "geometry_msgs/TransformStamped[] transforms",
        "nav_msgs/msg/Odometry": (
            "std_msgs/Header header\nstring child_frame_id\n"
            "geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist"
        ),
        "nav_msgs/msg/Path": "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses",
        "nav_msgs/msg/MapMetaData": (
            "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\n"
            "uint32 height\ngeometry_msgs/Pose origin"
        ),
        "nav_msgs/msg/OccupancyGrid": (
            "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data"
        ),
        "sensor_msgs/msg/LaserScan": (
            "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\n"
            "float32 angle_increment\nfloat32 time_increment\nfloat32 scan_time\n"
            "float32 range_min\nfloat32 range_max\nfloat32[] ranges\nfloat32[] intensities"
        ),
        "sensor_msgs/msg/CompressedImage": ("std_msgs/Header header\nstring format\nuint8[] data"),
        "visualization_msgs/msg/UVCoordinate": "float32 u\nfloat32 v",
        "visualization_msgs/msg/MeshFile": "string filename\nuint8[] data",
        "visualization_msgs/msg/Marker": (
            "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
            "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
            "builtin_interfaces/Duration lifetime\nbool frame_locked\n"
            "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\n"
            "string texture_resource\nsensor_msgs/CompressedImage texture\n"
            "visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\n"
            "string mesh_resource\nvisualization_msgs/MeshFile mesh_file\n"
            "bool mesh_use_embedded_materials"
        ),
        "visualization_msgs/msg/MarkerArray": "visualization_msgs/Marker[] markers",
        "rcl_interfaces/msg/Log": (
            "builtin_interfaces/Time stamp\nuint8 level\nstring name\nstring msg\nstring file\n"
            "string function\nuint32 line"
        ),
        "diagnostic_msgs/msg/KeyValue": "string key\nstring value",
        "diagnostic_msgs/msg/DiagnosticStatus": (
            "byte level\nstring name\nstring message\nstring hardware_id\n"
            "diagnostic_msgs/KeyValue[] values"
        ),
        "diagnostic_msgs/msg/DiagnosticArray": (
            "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status"
        ),
    }
)
"""The fields of each type, by its full name."""
