"""A stand-in for a ROS 2 node on rmw_cyclonedds: a service and an action server, on Python's DDS and its own encoder.

It puts rmw_cyclonedds's request header before each request and reply, tells its identifier in its endpoints' user data, and
replies once the client's reader is there, as rmw_cyclonedds does. It does nothing by itself: it reports each request on its
standard output, one JSON object per line, and takes what to do from its standard input. Loopback only. See service-peer.ts.
"""
import argparse
import json
import os
import queue
import secrets
import sys
import threading
import time
from dataclasses import asdict, dataclass

parser = argparse.ArgumentParser()
parser.add_argument("--domain", type=int, default=0)
parser.add_argument("--service", default="/charge")
parser.add_argument("--type", default="Trigger")
parser.add_argument("--action")
parser.add_argument("--identifier", default="yes")
asked = parser.parse_args()

os.environ["CYCLONEDDS_URI"] = (
    '<CycloneDDS><Domain Id="any"><General><Interfaces><NetworkInterface address="127.0.0.1" multicast="true"/></Interfaces>'
    "</General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    '<Peers><Peer Address="localhost"/></Peers></Discovery></Domain></CycloneDDS>'
)

from cyclonedds.core import Policy, Qos  # noqa: E402
from cyclonedds.domain import DomainParticipant  # noqa: E402
from cyclonedds.idl import IdlStruct  # noqa: E402
from cyclonedds.idl.annotations import final  # noqa: E402
from cyclonedds.idl.types import array, float64, int8, int32, int64, sequence, uint8, uint32, uint64  # noqa: E402
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
class UUID(IdlStruct, typename="unique_identifier_msgs.msg.dds_.UUID_"):
    uuid: array[uint8, 16]


@dataclass
@final
class GoalInfo(IdlStruct, typename="action_msgs.msg.dds_.GoalInfo_"):
    goal_id: UUID
    stamp: Time


@dataclass
@final
class GoalStatus(IdlStruct, typename="action_msgs.msg.dds_.GoalStatus_"):
    goal_info: GoalInfo
    status: int8


@dataclass
@final
class GoalStatusArray(IdlStruct, typename="action_msgs.msg.dds_.GoalStatusArray_"):
    status_list: sequence[GoalStatus]


@dataclass
@final
class Feedback(IdlStruct, typename="robot_msgs.action.dds_.Dock_FeedbackMessage_"):
    goal_id: UUID
    left: float64


@dataclass
@final
class EmptyRequest(IdlStruct, typename="std_srvs.srv.dds_.Empty_Request_"):
    guid: uint64
    seq: int64
    structure_needs_at_least_one_member: uint8


@dataclass
@final
class EmptyResponse(IdlStruct, typename="std_srvs.srv.dds_.Empty_Response_"):
    guid: uint64
    seq: int64
    structure_needs_at_least_one_member: uint8 = 0


@dataclass
@final
class TriggerRequest(IdlStruct, typename="std_srvs.srv.dds_.Trigger_Request_"):
    guid: uint64
    seq: int64
    structure_needs_at_least_one_member: uint8


@dataclass
@final
class TriggerResponse(IdlStruct, typename="std_srvs.srv.dds_.Trigger_Response_"):
    guid: uint64
    seq: int64
    success: bool = True
    message: str = ""


@dataclass
@final
class SetBoolRequest(IdlStruct, typename="std_srvs.srv.dds_.SetBool_Request_"):
    guid: uint64
    seq: int64
    data: bool


@dataclass
@final
class SetBoolResponse(IdlStruct, typename="std_srvs.srv.dds_.SetBool_Response_"):
    guid: uint64
    seq: int64
    success: bool = True
    message: str = ""


@dataclass
@final
class SendGoalRequest(IdlStruct, typename="robot_msgs.action.dds_.Dock_SendGoal_Request_"):
    guid: uint64
    seq: int64
    goal_id: UUID
    station: uint8
    distance: float64


@dataclass
@final
class SendGoalResponse(IdlStruct, typename="robot_msgs.action.dds_.Dock_SendGoal_Response_"):
    guid: uint64
    seq: int64
    accepted: bool
    stamp: Time


@dataclass
@final
class GetResultRequest(IdlStruct, typename="robot_msgs.action.dds_.Dock_GetResult_Request_"):
    guid: uint64
    seq: int64
    goal_id: UUID


@dataclass
@final
class GetResultResponse(IdlStruct, typename="robot_msgs.action.dds_.Dock_GetResult_Response_"):
    guid: uint64
    seq: int64
    status: int8
    charge: float64


@dataclass
@final
class CancelGoalRequest(IdlStruct, typename="action_msgs.srv.dds_.CancelGoal_Request_"):
    guid: uint64
    seq: int64
    goal_info: GoalInfo


@dataclass
@final
class CancelGoalResponse(IdlStruct, typename="action_msgs.srv.dds_.CancelGoal_Response_"):
    guid: uint64
    seq: int64
    return_code: int8
    goals_canceling: sequence[GoalInfo]


NOW = Time(5, 6)
participant = DomainParticipant(asked.domain)
RELIABLE = (Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(10))
CDR = Policy.DataRepresentation(use_cdrv0_representation=True)


def say(**what):
    sys.stdout.write(json.dumps(what, default=list) + "\n")
    sys.stdout.flush()


def key_of(qos, key):
    data = qos[Policy.Userdata]
    pairs = (pair.split("=", 1) for pair in (data.data if data else b"").decode().split(";") if "=" in pair)
    return dict(pairs).get(key)


class Service:
    """One service: its request reader and its reply writer, which have the same identifier."""

    def __init__(self, name, request, response):
        identifier = ".".join(f"{byte:x}" for byte in secrets.token_bytes(16))
        data = f"serviceid={identifier};".encode() if asked.identifier == "yes" else b""
        qos = Qos(*RELIABLE, Policy.Userdata(data))
        self.name, self.response = name, response
        self.writer = DataWriter(participant, Topic(participant, f"rr{name}Reply", response), qos=qos + Qos(CDR))
        self.reader = DataReader(participant, Topic(participant, f"rq{name}Request", request), qos=qos)

    def hears(self, handle):
        """Whether the reader that belongs to the writer of a request is there."""
        request_writer = self.reader.get_matched_publication_data(handle)
        client = key_of(request_writer.qos, "clientid") if request_writer else None
        readers = (self.writer.get_matched_subscription_data(each) for each in self.writer.get_matched_subscriptions())
        return client is not None and any(reader and key_of(reader.qos, "clientid") == client for reader in readers)


services = [Service(asked.service, globals()[f"{asked.type}Request"], globals()[f"{asked.type}Response"])]
status = feedback = None
if asked.action:
    below = f"{asked.action}/_action/"
    services += [
        Service(below + "send_goal", SendGoalRequest, SendGoalResponse),
        Service(below + "cancel_goal", CancelGoalRequest, CancelGoalResponse),
        Service(below + "get_result", GetResultRequest, GetResultResponse),
    ]
    feedback = DataWriter(participant, Topic(participant, f"rt{below}feedback", Feedback), qos=Qos(*RELIABLE, CDR))
    latched = Qos(RELIABLE[0], Policy.History.KeepLast(1), Policy.Durability.TransientLocal, CDR)
    status = DataWriter(participant, Topic(participant, f"rt{below}status", GoalStatusArray), qos=latched)

commands = queue.Queue()
heard = []


def read_commands():
    for line in sys.stdin:
        commands.put(json.loads(line))
    os._exit(0)


def do(command):
    what = command["do"]
    if what == "vanish":
        # Nothing else refers to their readers and writers.
        heard.clear()
        services.clear()
    elif what == "feedback":
        feedback.write(Feedback(UUID(bytes(command["goal"])), command["left"]))
    elif what == "status":
        status.write(GoalStatusArray([GoalStatus(GoalInfo(UUID(bytes(command["goal"])), NOW), command["status"])]))
    elif what == "reply":
        service, request, handle = heard[command["to"]]
        while not service.hears(handle):
            time.sleep(0.005)
        fields = command.get("fields", {})
        if service.response is SendGoalResponse:
            fields["stamp"] = NOW
        if "goals_canceling" in fields:
            fields["goals_canceling"] = [GoalInfo(UUID(bytes(goal)), NOW) for goal in fields["goals_canceling"]]
        guid = (request.guid + command.get("client", 0)) % 2**64
        service.writer.write(service.response(guid=guid, seq=request.seq + command.get("sequence", 0), **fields))


def take_requests():
    for service in services:
        for request in service.reader.take(N=16):
            if not request.sample_info.valid_data:
                continue
            fields = asdict(request)
            fields.pop("guid"), fields.pop("seq"), fields.pop("sample_info", None)
            client = f"{request.guid:016x}"
            say(event="request", number=len(heard), service=service.name, client=client, sequence=request.seq, fields=fields)
            heard.append((service, request, request.sample_info.publication_handle))


threading.Thread(target=read_commands, daemon=True).start()
say(event="ready")
while True:
    while not commands.empty():
        do(commands.get())
    take_requests()
    time.sleep(0.005)
