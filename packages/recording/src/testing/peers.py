"""The peers of the tests: PyPI mcap, mcap-ros2-support, mcap-ros1-support and rosbags write recordings and read ours.

    peers.py write FOLDER      the same drive in every format
    peers.py read FILE         what is in an MCAP file, as JSON
    peers.py count FILE        the same as rosbags sees it: messages of each topic, deserialised
"""

import json
import math
import sys
from pathlib import Path

import numpy as np

CLOUDS = 20
POINTS = 500
START_S = 1_700_000_000
TRANSFORMS = 100


def cloud_bytes(k: int) -> bytes:
    """x forward k + i / 1000, y left i / 100, z up 0.5, intensity i; as a LiDAR driver packs it, with a ring and a time."""
    layout = np.dtype({
        "names": ["x", "y", "z", "intensity", "ring", "time"],
        "formats": ["<f4", "<f4", "<f4", "<f4", "<u2", "<f4"],
        "offsets": [0, 4, 8, 12, 16, 18],
        "itemsize": 22,
    })
    points = np.zeros(POINTS, layout)
    i = np.arange(POINTS)
    points["x"], points["y"], points["z"], points["intensity"] = k + i / 1000, i / 100, 0.5, i
    return points.tobytes()


FIELDS = [("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("intensity", 12, 7), ("ring", 16, 4), ("time", 18, 7)]


def events():
    """(time in ns, topic, kind, content), in order: 2 s at 10 clouds and 50 transforms a second, 1 m/s ahead."""
    found = [(START_S * 10**9, "/tf_static", "tf", [("base_link", "lidar", (0.5, 0, 1.0), 0.0)])]
    for n in range(TRANSFORMS):
        at = START_S * 10**9 + n * 20_000_000
        # A transform is published a little later than what it is of.
        found.append((at + 5_000_000, "/tf", "tf", [("odom", "base_link", (n * 0.02, 0, 0), math.pi / 2)], at))
        found.append((at + 6_000_000, "/odom", "odom", (n * 0.02, 1.0), at))
    for k in range(CLOUDS):
        found.append((START_S * 10**9 + k * 100_000_000, "/points", "cloud", k))
    return sorted(found, key=lambda event: event[0])


def message_of(types, kind, content, at, ros1):
    header_extra = {"seq": 0} if ros1 else {}
    message = lambda name: types.types[name]
    time = message("builtin_interfaces/msg/Time")(sec=at // 10**9, nanosec=at % 10**9)
    header = lambda frame: message("std_msgs/msg/Header")(stamp=time, frame_id=frame, **header_extra)
    quaternion = lambda yaw: message("geometry_msgs/msg/Quaternion")(x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2))
    vector = lambda x, y, z: message("geometry_msgs/msg/Vector3")(x=float(x), y=float(y), z=float(z))
    if kind == "cloud":
        field = message("sensor_msgs/msg/PointField")
        return "sensor_msgs/msg/PointCloud2", message("sensor_msgs/msg/PointCloud2")(
            header=header("lidar"), height=1, width=POINTS,
            fields=[field(name=name, offset=offset, datatype=kind, count=1) for name, offset, kind in FIELDS],
            is_bigendian=False, point_step=22, row_step=22 * POINTS,
            data=np.frombuffer(cloud_bytes(content), np.uint8), is_dense=True)
    if kind == "tf":
        transform = message("geometry_msgs/msg/TransformStamped")
        return "tf2_msgs/msg/TFMessage", message("tf2_msgs/msg/TFMessage")(transforms=[
            transform(header=header(parent), child_frame_id=child,
                      transform=message("geometry_msgs/msg/Transform")(translation=vector(*place), rotation=quaternion(yaw)))
            for parent, child, place, yaw in content])
    x, speed = content
    covariance = np.zeros(36)
    pose = message("geometry_msgs/msg/Pose")(
        position=message("geometry_msgs/msg/Point")(x=float(x), y=0.0, z=0.0), orientation=quaternion(0))
    twist = message("geometry_msgs/msg/Twist")(linear=vector(speed, 0, 0), angular=vector(0, 0, 0))
    return "nav_msgs/msg/Odometry", message("nav_msgs/msg/Odometry")(
        header=header("odom"), child_frame_id="base_link",
        pose=message("geometry_msgs/msg/PoseWithCovariance")(pose=pose, covariance=covariance),
        twist=message("geometry_msgs/msg/TwistWithCovariance")(twist=twist, covariance=covariance))


def write(folder: Path) -> None:
    from mcap.writer import CompressionType, Writer as McapWriter
    from rosbags.rosbag1 import Writer as Bag1
    from rosbags.typesys import Stores, get_typestore, get_types_from_msg

    ros1 = get_typestore(Stores.ROS1_NOETIC)
    ros2 = get_typestore(Stores.ROS2_HUMBLE)
    if "tf2_msgs/msg/TFMessage" not in ros1.types:
        ros1.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
    drive = [(event[0], event[1], event[2], event[3], event[4] if len(event) > 4 else event[0]) for event in events()]

    for name, compression in [("none", None), ("lz4", Bag1.CompressionFormat.LZ4), ("bz2", Bag1.CompressionFormat.BZ2)]:
        bag = Bag1(folder / f"bag-{name}.bag")
        if compression is not None:
            bag.set_compression(compression)
        with bag:
            connections = {}
            for log, topic, kind, content, at in drive:
                type_name, message = message_of(ros1, kind, content, at, True)
                if topic not in connections:
                    connections[topic] = bag.add_connection(topic, type_name, typestore=ros1)
                bag.write(connections[topic], log, ros1.serialize_ros1(message, type_name))

    for name, compression, store, ros in [
        ("ros2-none", CompressionType.NONE, ros2, 2), ("ros2-lz4", CompressionType.LZ4, ros2, 2),
        ("ros2-zstd", CompressionType.ZSTD, ros2, 2), ("ros1-zstd", CompressionType.ZSTD, ros1, 1),
    ]:
        with open(folder / f"mcap-{name}.mcap", "wb") as file:
            writer = McapWriter(file, compression=compression, chunk_size=64 * 1024)
            writer.start(profile=f"ros{ros}", library="peers.py")
            channels = {}
            for n, (log, topic, kind, content, at) in enumerate(drive):
                type_name, message = message_of(store, kind, content, at, ros == 1)
                if topic not in channels:
                    definition, _ = store.generate_msgdef(type_name, ros_version=ros)
                    schema = writer.register_schema(
                        name=type_name if ros == 2 else type_name.replace("/msg/", "/"),
                        encoding=f"ros{ros}msg", data=definition.encode())
                    channels[topic] = writer.register_channel(
                        topic=topic, message_encoding="cdr" if ros == 2 else "ros1", schema_id=schema)
                data = store.serialize_cdr(message, type_name) if ros == 2 else store.serialize_ros1(message, type_name)
                writer.add_message(channels[topic], log_time=log, publish_time=log, sequence=n, data=bytes(data))
            writer.finish()
    write_by_rosbags(folder, drive, ros2)


def write_by_rosbags(folder: Path, drive, ros2) -> None:
    """A ROS 2 bag as its own recorder lays it out: a folder with an MCAP file in it."""
    from rosbags.rosbag2 import StoragePlugin, Writer

    with Writer(folder / "rosbag2", version=9, storage_plugin=StoragePlugin.MCAP) as bag:
        connections = {}
        for log, topic, kind, content, at in drive:
            type_name, message = message_of(ros2, kind, content, at, False)
            if topic not in connections:
                connections[topic] = bag.add_connection(topic, type_name, typestore=ros2)
            bag.write(connections[topic], log, ros2.serialize_cdr(message, type_name))


def read(path: Path) -> None:
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory

    topics: dict = {}
    with open(path, "rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        summary, profile = reader.get_summary(), reader.get_header().profile
        for schema, channel, message in reader.iter_messages():
            entry = topics.setdefault(channel.topic, {"type": schema.name if schema else "", "count": 0, "sums": []})
            entry["count"] += 1
            if channel.message_encoding == "cdr":
                decoded = DecoderFactory().decoder_for("cdr", schema)(message.data)
                if schema.name == "sensor_msgs/msg/PointCloud2":
                    entry["sums"].append(sum_of(decoded))
            else:
                decoded = json.loads(message.data)
                entry.setdefault("last", decoded)
            entry["sequence"] = message.sequence
    statistics = summary.statistics
    print(json.dumps({
        "topics": topics,
        "messages": statistics.message_count,
        "chunks": statistics.chunk_count,
        "profile": profile,
    }))


def count(path: Path) -> None:
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    counts: dict = {}
    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        for connection, _, data in reader.messages():
            if connection.ext.serialization_format == "cdr":
                reader.deserialize(data, connection.msgtype)
            else:
                json.loads(bytes(data))
            counts[connection.topic] = counts.get(connection.topic, 0) + 1
    print(json.dumps(counts))


def sum_of(cloud) -> list:
    """Points, and the sums of x, y, z and of the packed colours."""
    layout = np.dtype({
        "names": [field.name for field in cloud.fields],
        "formats": [{7: "<f4", 6: "<u4"}[field.datatype] for field in cloud.fields],
        "offsets": [field.offset for field in cloud.fields],
        "itemsize": cloud.point_step,
    })
    points = np.frombuffer(bytes(cloud.data), layout)
    return [len(points), *(float(np.nansum(points[axis].astype(np.float64))) for axis in "xyz")]


if __name__ == "__main__":
    {"write": write, "read": read, "count": count}[sys.argv[1]](Path(sys.argv[2]))
