"""A rospy node for tests: publishes clouds, pictures and small topics, offers services, and prints the velocities and
switches it receives, one per line.
"""

import json
import sys
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped, Twist, TwistStamped
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from sensor_msgs.msg import BatteryState, CameraInfo, CompressedImage, Image, PointCloud2, PointField
from std_msgs.msg import Bool, Empty, Float32

CLOUD_SIDE = 480
FOCAL = 400.0


def cloud():
    """A grid of 480 x 480 points, 20 bytes each, on a plane 2 m ahead; the colour is orange."""
    import struct

    message = PointCloud2(height=CLOUD_SIDE, width=CLOUD_SIDE, point_step=20, is_dense=True)
    message.header.frame_id = "camera_optical_frame"
    names = (("x", 0), ("y", 4), ("z", 8), ("rgb", 16))
    message.fields = [PointField(name, offset, PointField.FLOAT32, 1) for name, offset in names]
    message.row_step = message.point_step * CLOUD_SIDE
    rows = []
    for v in range(CLOUD_SIDE):
        y = (v - CLOUD_SIDE / 2) / FOCAL * 2.0
        for u in range(CLOUD_SIDE):
            rows.append(struct.pack("<ffffI", (u - CLOUD_SIDE / 2) / FOCAL * 2.0, y, 2.0, 0.0, 0xFF8000))
    message.data = b"".join(rows)
    return message


def camera_info():
    message = CameraInfo(width=CLOUD_SIDE, height=CLOUD_SIDE)
    half = CLOUD_SIDE / 2
    message.K = [FOCAL, 0, half, 0, FOCAL, half, 0, 0, 1]
    message.P = [FOCAL, 0, half, 0, 0, FOCAL, half, 0, 0, 0, 1, 0]
    message.header.frame_id = "camera_optical_frame"
    return message


def image():
    message = Image(width=640, height=480, encoding="bgr8", step=640 * 3)
    message.header.frame_id = "camera_optical_frame"
    message.data = bytes((10, 20, 30)) * (640 * 480)
    return message


def bars():
    """1280 x 960 pixels: four bars from left to right: red, green, blue, white."""
    message = Image(width=1280, height=960, encoding="bgr8", step=1280 * 3)
    row = b"".join(bytes(bgr) * 320 for bgr in ((0, 0, 255), (0, 255, 0), (255, 0, 0), (255, 255, 255)))
    message.data = row * 960
    return message


def broken_jpeg():
    """A header for 320 x 240 pixels, followed by nothing that could be decoded."""
    frame = bytes((0xFF, 0xC0, 0, 17, 8, 0, 240, 1, 64, 3, 1, 0x22, 0, 2, 0x11, 1, 3, 0x11, 1))
    return b"\xff\xd8" + frame + b"\xff\xda" + bytes(range(200))


def odometry(count):
    message = Odometry(child_frame_id="base_link")
    message.header.frame_id = "odom"
    message.pose.pose.position.x = 3.0
    message.pose.pose.orientation.w = 1.0
    message.twist.twist.linear.x = 0.125
    return message


def plan():
    message = Path()
    message.header.frame_id = "odom"
    for x, y in ((3.0, 0.0), (4.0, 0.0), (5.0, 0.0), (5.0, 2.0)):
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.position.y, pose.pose.orientation.w = x, y, 1.0
        message.poses.append(pose)
    return message


def grid():
    """40 x 2 cells: the lower row is free, the upper one occupied, and its last cell unknown."""
    message = OccupancyGrid(data=[0] * 40 + [100] * 39 + [-1])
    message.header.frame_id = "odom"
    message.info.width, message.info.height, message.info.resolution = 40, 2, 0.5
    message.info.origin.position.x, message.info.origin.orientation.w = -1.0, 1.0
    return message


def say(line):
    """One write: rospy calls back in several threads, and two lines must not be mixed."""
    sys.stdout.write(json.dumps(line) + "\n")
    sys.stdout.flush()


def heard(topic):
    def on_velocity(message):
        twist = message.twist if hasattr(message, "twist") else message
        line = {"topic": topic, "x": twist.linear.x, "turn": twist.angular.z, "nodeMs": time.time() * 1000}
        say(line)

    return on_velocity


def switched(topic, on):
    say({"topic": topic, "x": float(on), "turn": 0.0, "nodeMs": time.time() * 1000})


def service_type(name, request, request_text, response_text):
    """A service of std_srvs, of which nothing else need be installed."""
    import hashlib

    from genpy.dynamic import generate_dynamic

    response = generate_dynamic("std_srvs/%sResponse" % name, response_text)["std_srvs/%sResponse" % name]

    class Service:
        _type = "std_srvs/" + name
        _md5sum = hashlib.md5((request_text + response_text).strip().encode()).hexdigest()
        _request_class = request
        _response_class = response

    return Service


def offer_services():
    """One that does what it is asked, one that cannot, one that breaks, one that hangs, and a switch."""
    from genpy.dynamic import generate_dynamic

    text = "bool success\nstring message"
    trigger = service_type("Trigger", Empty, "", text)
    switch_request = generate_dynamic("std_srvs/SetBoolRequest", "bool data")["std_srvs/SetBoolRequest"]
    switch = service_type("SetBool", switch_request, "bool data", text)

    def breaks(_request):
        raise ValueError("out of order")

    def hangs(_request):
        time.sleep(3600)

    def on_switch(request):
        switched("/horn", request.data)
        return switch._response_class(True, "")

    rospy.Service("/dock", trigger, lambda _request: trigger._response_class(True, "docked"))
    rospy.Service("/charge", trigger, lambda _request: trigger._response_class(False, "no charger"))
    rospy.Service("/breaks", trigger, breaks)
    rospy.Service("/hangs", trigger, hangs)
    rospy.Service("/horn", switch, on_switch)


def main():
    parts = sys.argv[1].split(",")
    rospy.init_node(sys.argv[2], disable_signals=True)
    if "velocity" in parts:
        rospy.Subscriber("/cmd_vel", Twist, heard("/cmd_vel"), queue_size=1, tcp_nodelay=True)
        rospy.Subscriber("/cmd_vel_stamped", TwistStamped, heard("/cmd_vel_stamped"), queue_size=1)
    if "commands" in parts:
        rospy.Subscriber("/lights", Bool, lambda message: switched("/lights", message.data), queue_size=5)
        offer_services()
    publishers = []
    if "cloud" in parts:
        publishers.append((rospy.Publisher("/points", PointCloud2, queue_size=1), cloud()))
        publishers.append((rospy.Publisher("/camera_info", CameraInfo, queue_size=1), camera_info()))
    if "image" in parts:
        publishers.append((rospy.Publisher("/image", Image, queue_size=1), image()))
    if "pictures" in parts:
        publishers.append((rospy.Publisher("/front/image_raw", Image, queue_size=1), bars()))
        rear = CompressedImage(format="jpeg", data=broken_jpeg())
        publishers.append((rospy.Publisher("/rear/image_raw/compressed", CompressedImage, queue_size=1), rear))
    if "state" in parts:
        publishers.append((rospy.Publisher("/odom", Odometry, queue_size=1), odometry(0)))
        battery = BatteryState(voltage=25.1, percentage=0.75, current=float("nan"))
        publishers.append((rospy.Publisher("/battery", BatteryState, queue_size=1), battery))
        publishers.append((rospy.Publisher("/temperature", Float32, queue_size=1), Float32(21.5)))
    if "rgbd" in parts:
        depth = Image(width=CLOUD_SIDE, height=CLOUD_SIDE, encoding="16UC1", step=CLOUD_SIDE * 2)
        depth.data = (2000).to_bytes(2, "little") * (CLOUD_SIDE * CLOUD_SIDE)
        colour = Image(width=CLOUD_SIDE, height=CLOUD_SIDE, encoding="rgb8", step=CLOUD_SIDE * 3)
        colour.data = bytes((255, 128, 0)) * (CLOUD_SIDE * CLOUD_SIDE)
        for message in (depth, colour):
            message.header.frame_id = "camera_optical_frame"
        publishers.append((rospy.Publisher("/rgbd/depth", Image, queue_size=1), depth))
        publishers.append((rospy.Publisher("/rgbd/colour", Image, queue_size=1), colour))
        publishers.append((rospy.Publisher("/rgbd/camera_info", CameraInfo, queue_size=1), camera_info()))
    if "diagnostics" in parts:
        motor = DiagnosticStatus(level=1, name="left motor", message="71 degrees, which is too warm to go on for long")
        array = DiagnosticArray(status=[motor, DiagnosticStatus(level=0, name="imu", message="fine")])
        publishers.append((rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1), array))
    if "navigator" in parts:
        publishers.append((rospy.Publisher("/plan", Path, queue_size=1), plan()))
        # Once, for everybody who comes later.
        latched = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
        latched.publish(grid())
    if "own" in parts:
        from genpy.dynamic import generate_dynamic

        own = generate_dynamic("my_robot/Arm", "float32[] joints\nstring mode\n")["my_robot/Arm"]
        publishers.append((rospy.Publisher("/arm", own, queue_size=1), own(joints=[0.5, 1.5], mode="hold")))
    say({"ready": True})
    rate = rospy.Rate(float(sys.argv[3]))
    while not rospy.is_shutdown():
        now = rospy.Time.now()
        for publisher, message in publishers:
            if hasattr(message, "header"):
                message.header.stamp = now
            publisher.publish(message)
        rate.sleep()


main()
