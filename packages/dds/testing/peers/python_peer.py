"""A program on Python's DDS, like another vendor's ROS 2 node: publishes clouds, receives Twists and sends them back.

Loopback only. Its command line says what to do; it reports events on its standard output, one JSON object per line,
and ends with its standard input. See peers.ts.
"""
import argparse
import json
import os
import struct
import sys
import threading
import time
from dataclasses import dataclass

parser = argparse.ArgumentParser()
parser.add_argument("--domain", type=int, default=0)
parser.add_argument("--cloud")
parser.add_argument("--side", type=int, default=480)
parser.add_argument("--hz", type=float, default=10)
parser.add_argument("--reliability", default="reliable")
parser.add_argument("--twist")
parser.add_argument("--echo")
asked = parser.parse_args()

os.environ["CYCLONEDDS_URI"] = (
    '<CycloneDDS><Domain Id="any"><General><Interfaces><NetworkInterface address="127.0.0.1" multicast="true"/></Interfaces>'
    "<MaxMessageSize>65500B</MaxMessageSize></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    '<Peers><Peer Address="localhost"/></Peers></Discovery></Domain></CycloneDDS>'
)

from cyclonedds.core import Listener, Policy, Qos  # noqa: E402
from cyclonedds.domain import DomainParticipant  # noqa: E402
from cyclonedds.idl import IdlStruct  # noqa: E402
from cyclonedds.idl.annotations import final  # noqa: E402
from cyclonedds.idl.types import float64, int32, sequence, uint8, uint32  # noqa: E402
from cyclonedds.pub import DataWriter  # noqa: E402
from cyclonedds.sub import DataReader  # noqa: E402
from cyclonedds.topic import Topic  # noqa: E402
from cyclonedds.util import duration  # noqa: E402


@dataclass
@final
class Time(IdlStruct, typename="builtin_interfaces.msg.dds_.Time_"):
    sec: int32
    nanosec: uint32


@dataclass
@final
class Header(IdlStruct, typename="std_msgs.msg.dds_.Header_"):
    stamp: Time
    frame_id: str


@dataclass
@final
class PointField(IdlStruct, typename="sensor_msgs.msg.dds_.PointField_"):
    name: str
    offset: uint32
    datatype: uint8
    count: uint32


@dataclass
@final
class PointCloud2(IdlStruct, typename="sensor_msgs.msg.dds_.PointCloud2_"):
    header: Header
    height: uint32
    width: uint32
    fields: sequence[PointField]
    is_bigendian: bool
    point_step: uint32
    row_step: uint32
    data: sequence[uint8]
    is_dense: bool


@dataclass
@final
class Vector3(IdlStruct, typename="geometry_msgs.msg.dds_.Vector3_"):
    x: float64
    y: float64
    z: float64


@dataclass
@final
class Twist(IdlStruct, typename="geometry_msgs.msg.dds_.Twist_"):
    linear: Vector3
    angular: Vector3


def say(**what):
    sys.stdout.write(json.dumps(what) + "\n")
    sys.stdout.flush()


participant = DomainParticipant(asked.domain)
RELIABLE = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(1))

echo = None
if asked.echo:
    echo = DataWriter(participant, Topic(participant, asked.echo, Twist), qos=RELIABLE)


class OnTwist(Listener):
    def on_data_available(self, reader):
        for twist in reader.take(N=16):
            if not isinstance(twist, Twist):
                continue
            if echo is not None:
                echo.write(twist)
            say(event="twist", x=twist.linear.x, z=twist.angular.z, ms=time.monotonic() * 1000)


reader = None
if asked.twist:
    reader = DataReader(participant, Topic(participant, asked.twist, Twist), qos=RELIABLE, listener=OnTwist())


class Clouds:
    """Clouds of side × side points, all in the frame's own colour: its number with mixed bits.

    The library takes a second to serialise four million bytes, so this does it once and then changes the bytes that
    differ.
    """

    def __init__(self, side):
        self.side = side
        names = ("x", "y", "z", "rgb")
        self.sample = PointCloud2(
            header=Header(Time(0, 0), "camera"),
            height=side,
            width=side,
            fields=[PointField(name, 4 * i, 7, 1) for i, name in enumerate(names)],
            is_bigendian=False,
            point_step=16,
            row_step=16 * side,
            data=list(self.row(0) * side),
            is_dense=True,
        )
        self.sample.serialize = self.serialize
        self.bytes = None

    def row(self, number):
        colour = number * 0x9E3779 & 0xFFFFFF
        return b"".join(struct.pack("<fffI", i / self.side - 0.5, 0.0, 2.0, colour) for i in range(self.side))

    def serialize(self, use_version_2=None):
        if self.bytes is None:
            self.bytes = bytearray(PointCloud2.serialize(self.sample, use_version_2=use_version_2))
            self.begin = self.bytes.index(self.row(0))
            self.bytes_of_data = len(self.row(0)) * self.side
        now = time.time()
        struct.pack_into("<iI", self.bytes, 4, int(now), int(now % 1 * 1e9))
        self.bytes[self.begin : self.begin + self.bytes_of_data] = self.row(self.number) * self.side
        return bytes(self.bytes)

    def next(self, number):
        self.number = number
        return self.sample


def give_clouds():
    reliability = (
        Policy.Reliability.Reliable(duration(seconds=1))
        if asked.reliability == "reliable"
        else Policy.Reliability.BestEffort
    )
    writer = DataWriter(
        participant, Topic(participant, asked.cloud, PointCloud2), qos=Qos(reliability, Policy.History.KeepLast(5))
    )
    clouds = Clouds(asked.side)
    clouds.next(0).serialize(writer._use_version_2)
    number, begin = 0, time.monotonic()
    while True:
        number += 1
        writer.write(clouds.next(number))
        time.sleep(max(0.0, begin + number / asked.hz - time.monotonic()))


if asked.cloud:
    threading.Thread(target=give_clouds, daemon=True).start()
say(event="ready")
for _ in sys.stdin:
    pass
os._exit(0)
