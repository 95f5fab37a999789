"""The peers of the tests: PyPI mcap, mcap-ros2-support, mcap-ros1-support and rosbags write recordings and read ours.

    peers.py write FOLDER      the same drive in every format
    peers.py pictures FOLDER   clouds and pictures, as ROS 1, ROS 2 and Foxglove write them
    peers.py read FILE         what is in an MCAP file, as JSON
    peers.py count FILE        the same as rosbags sees it: messages of each topic, deserialised
"""

import base64
import hashlib
import json
import math
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

CLOUDS = 20
POINTS = 500
START_S = 1_700_000_000
TRANSFORMS = 100


def cloud_bytes(k: int) -> bytes:
    """x forward k + i / 1000, y left i / 100, z up 0.5, intensity i; packed as by a LiDAR driver, with a ring and a
    time.
    """
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
    """(time in ns, topic, kind, content), in order: 2 s with 10 clouds and 50 transforms per second, 1 m/s ahead."""
    found = [(START_S * 10**9, "/tf_static", "tf", [("base_link", "lidar", (0.5, 0, 1.0), 0.0)])]
    for n in range(TRANSFORMS):
        at = START_S * 10**9 + n * 20_000_000
        # A transform is published slightly later than the time it describes.
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
    """A ROS 2 bag as written by ROS 2's own recorder: a folder with an MCAP file in it."""
    from rosbags.rosbag2 import StoragePlugin, Writer

    with Writer(folder / "rosbag2", version=9, storage_plugin=StoragePlugin.MCAP) as bag:
        connections = {}
        for log, topic, kind, content, at in drive:
            type_name, message = message_of(ros2, kind, content, at, False)
            if topic not in connections:
                connections[topic] = bag.add_connection(topic, type_name, typestore=ros2)
            bag.write(connections[topic], log, ros2.serialize_cdr(message, type_name))


PICTURES = 10
WIDTH, HEIGHT = 8, 4


def pixels(k: int) -> bytes:
    """R, G, B of each pixel: red identifies the picture."""
    return bytes((k * 20, 50, 100)) * (WIDTH * HEIGHT)


def png(k: int) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + pixels(k)[: WIDTH * 3] for _ in range(HEIGHT))
    head = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def picture_message(types, compressed: bool, k: int, at: int, ros1: bool):
    time = types.types["builtin_interfaces/msg/Time"](sec=at // 10**9, nanosec=at % 10**9)
    header = types.types["std_msgs/msg/Header"](stamp=time, frame_id="camera", **({"seq": 0} if ros1 else {}))
    if compressed:
        data = np.frombuffer(png(k), np.uint8)
        return "sensor_msgs/msg/CompressedImage", types.types["sensor_msgs/msg/CompressedImage"](
            header=header, format="rgb8; png compressed ", data=data)
    return "sensor_msgs/msg/Image", types.types["sensor_msgs/msg/Image"](
        header=header, height=HEIGHT, width=WIDTH, encoding="rgb8", is_bigendian=0, step=WIDTH * 3,
        data=np.frombuffer(pixels(k), np.uint8))


def write_pictures(folder: Path) -> None:
    """A cloud every 100 ms, and 50 ms after it one picture of each topic."""
    from mcap.writer import Writer as McapWriter
    from rosbags.rosbag1 import Writer as Bag1
    from rosbags.typesys import Stores, get_typestore

    ros1 = get_typestore(Stores.ROS1_NOETIC)
    ros2 = get_typestore(Stores.ROS2_HUMBLE)

    def messages(types, is_ros1: bool):
        for k in range(PICTURES):
            at = START_S * 10**9 + k * 100_000_000
            yield at, "/points", *message_of(types, "cloud", k, at, is_ros1)
            for topic, compressed in (("/raw", False), ("/file/compressed", True)):
                yield at + 50_000_000, topic, *picture_message(types, compressed, k, at + 50_000_000, is_ros1)

    with Bag1(folder / "ros1.bag") as bag:
        connections = {}
        for log, topic, type_name, message in messages(ros1, True):
            if topic not in connections:
                connections[topic] = bag.add_connection(topic, type_name, typestore=ros1)
            bag.write(connections[topic], log, ros1.serialize_ros1(message, type_name))

    for ros, types in ((1, ros1), (2, ros2)):
        with open(folder / f"ros{ros}.mcap", "wb") as file:
            writer = McapWriter(file, chunk_size=64 * 1024)
            writer.start(profile=f"ros{ros}", library="peers.py")
            channels = {}
            for log, topic, type_name, message in messages(types, ros == 1):
                if topic not in channels:
                    channels[topic] = ros_channel(writer, types, topic, type_name, ros)
                data = (types.serialize_cdr if ros == 2 else types.serialize_ros1)(message, type_name)
                writer.add_message(channels[topic], log_time=log, publish_time=log, data=bytes(data))
            writer.finish()
    write_foxglove_pictures(folder / "foxglove.mcap", ros2)


def ros_channel(writer, types, topic: str, type_name: str, ros: int) -> int:
    definition, _ = types.generate_msgdef(type_name, ros_version=ros)
    schema = writer.register_schema(
        name=type_name if ros == 2 else type_name.replace("/msg/", "/"),
        encoding=f"ros{ros}msg", data=definition.encode())
    return writer.register_channel(topic=topic, message_encoding="cdr" if ros == 2 else "ros1", schema_id=schema)


def write_foxglove_pictures(path: Path, ros2) -> None:
    from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
    from foxglove_schemas_protobuf.RawImage_pb2 import RawImage
    from google.protobuf.descriptor_pb2 import FileDescriptorSet
    from mcap.writer import Writer as McapWriter

    def descriptors(file, into) -> FileDescriptorSet:
        for other in file.dependencies:
            descriptors(other, into)
        file.CopyToProto(into.file.add())
        return into

    with open(path, "wb") as file:
        writer = McapWriter(file, chunk_size=64 * 1024)
        writer.start(profile="", library="peers.py")
        clouds = ros_channel(writer, ros2, "/points", "sensor_msgs/msg/PointCloud2", 2)
        protobuf = {}
        for topic, kind in (("/protobuf", CompressedImage), ("/protobuf_raw", RawImage)):
            data = descriptors(kind.DESCRIPTOR.file, FileDescriptorSet()).SerializeToString()
            schema = writer.register_schema(name=kind.DESCRIPTOR.full_name, encoding="protobuf", data=data)
            protobuf[topic] = writer.register_channel(topic=topic, message_encoding="protobuf", schema_id=schema)
        schema = writer.register_schema(name="foxglove.CompressedImage", encoding="jsonschema", data=b"{}")
        words = writer.register_channel(topic="/json", message_encoding="json", schema_id=schema)
        for k in range(PICTURES):
            at = START_S * 10**9 + k * 100_000_000
            type_name, cloud = message_of(ros2, "cloud", k, at, False)
            writer.add_message(clouds, log_time=at, publish_time=at, data=bytes(ros2.serialize_cdr(cloud, type_name)))
            at += 50_000_000
            compressed = CompressedImage(frame_id="camera", format="png", data=png(k))
            raw = RawImage(frame_id="camera", width=WIDTH, height=HEIGHT, encoding="rgb8", step=WIDTH * 3, data=pixels(k))
            for topic, message in (("/protobuf", compressed), ("/protobuf_raw", raw)):
                message.timestamp.FromNanoseconds(at)
                writer.add_message(protobuf[topic], log_time=at, publish_time=at, data=message.SerializeToString())
            data = base64.b64encode(png(k)).decode()
            stamp = {"sec": at // 10**9, "nsec": at % 10**9}
            text = json.dumps({"timestamp": stamp, "frame_id": "camera", "format": "png", "data": data})
            writer.add_message(words, log_time=at, publish_time=at, data=text.encode())
        writer.finish()


def read(path: Path) -> None:
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory

    topics: dict = {}
    with open(path, "rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        summary, profile = reader.get_summary(), reader.get_header().profile
        for schema, channel, message in reader.iter_messages():
            entry = topics.setdefault(channel.topic, {
                "type": schema.name if schema else "", "metadata": channel.metadata, "count": 0, "sums": [], "pictures": []})
            entry["count"] += 1
            if channel.message_encoding == "cdr":
                decoded = DecoderFactory().decoder_for("cdr", schema)(message.data)
                if schema.name == "sensor_msgs/msg/PointCloud2":
                    entry["sums"].append(sum_of(decoded))
                if schema.name in ("foxglove_msgs/msg/CompressedImage", "foxglove_msgs/msg/CompressedVideo"):
                    data = bytes(decoded.data)
                    entry["pictures"].append({
                        "stampNs": str(decoded.timestamp.sec * 10**9 + decoded.timestamp.nanosec),
                        "logNs": str(message.log_time), "frame": decoded.frame_id, "format": decoded.format,
                        "bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()})
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
    """Number of points, and the sums of x, y, z and of the packed colours."""
    layout = np.dtype({
        "names": [field.name for field in cloud.fields],
        "formats": [{7: "<f4", 6: "<u4"}[field.datatype] for field in cloud.fields],
        "offsets": [field.offset for field in cloud.fields],
        "itemsize": cloud.point_step,
    })
    points = np.frombuffer(bytes(cloud.data), layout)
    return [len(points), *(float(np.nansum(points[axis].astype(np.float64))) for axis in "xyz")]


if __name__ == "__main__":
    {"write": write, "pictures": write_pictures, "read": read, "count": count}[sys.argv[1]](Path(sys.argv[2]))
