"""A camera in a network, for tests: GStreamer's RTSP server (gst-rtsp-server), H.264 or JPEG, 30 pictures/s.

Each picture carries the time at which it was made, in the latency barcode (docs/protocol.md). Says its port on a line.

usage: rtsp_camera.py PORT CODING [USER PASSWORD]     PORT 0 takes a free one; CODING: h264 or jpeg
"""

import sys
import time

import gi

gi.require_version("Gst", "1.0")
gi.require_version("GstRtsp", "1.0")
gi.require_version("GstRtspServer", "1.0")
from gi.repository import GLib, Gst, GstRtsp, GstRtspServer  # noqa: E402

WIDTH, HEIGHT, RATE = 320, 240, 30
SQUARE, COLUMNS, ROWS = 8, 18, 7
CODINGS = {
    "h264": "x264enc tune=zerolatency speed-preset=ultrafast key-int-max=30 bitrate=1000 ! rtph264pay name=pay0",
    "jpeg": "jpegenc ! rtpjpegpay name=pay0",
}


def checksum(data):
    """CRC-16/CCITT-FALSE."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ (0x1021 if crc & 0x8000 else 0)) & 0xFFFF
    return crc


def picture(nanoseconds):
    """I420, grey but for the barcode in the corner."""
    data = nanoseconds.to_bytes(8, "big")
    data += checksum(data).to_bytes(2, "big")
    luma = bytearray(b"\x80" * (WIDTH * HEIGHT))
    for row in range(ROWS):
        line = bytearray()
        for column in range(COLUMNS):
            if row in (0, ROWS - 1) or column in (0, COLUMNS - 1):
                white = (row + column) % 2 == 0
            else:
                word = data[2 * row - 2] << 8 | data[2 * row - 1]
                white = word >> (16 - column) & 1
            line += (b"\xeb" if white else b"\x10") * SQUARE
        for y in range(row * SQUARE, (row + 1) * SQUARE):
            luma[y * WIDTH : y * WIDTH + len(line)] = line
    return bytes(luma) + b"\x80" * (WIDTH * HEIGHT // 2)


def feed(source):
    """Returns whether it goes on."""
    flow = source.emit("push-buffer", Gst.Buffer.new_wrapped(picture(time.monotonic_ns())))
    return flow == Gst.FlowReturn.OK


def configured(_, media):
    source = media.get_element().get_by_name_recurse_up("camera")
    GLib.timeout_add(1000 // RATE, feed, source)


def guard(server, factory, user, password):
    """Only this user is let in."""
    token = GstRtspServer.RTSPToken()
    token.set_string("media.factory.role", "viewer")
    auth = GstRtspServer.RTSPAuth()
    auth.set_supported_methods(GstRtsp.RTSPAuthMethod.DIGEST)
    auth.add_digest(user, password, token)
    server.set_auth(auth)
    permissions = GstRtspServer.RTSPPermissions()
    permissions.add_permission_for_role("viewer", "media.factory.access", True)
    permissions.add_permission_for_role("viewer", "media.factory.construct", True)
    factory.set_permissions(permissions)


def main():
    port, coding, *login = sys.argv[1:]
    Gst.init(None)
    server = GstRtspServer.RTSPServer()
    server.set_address("127.0.0.1")
    server.set_service(port)
    factory = GstRtspServer.RTSPMediaFactory()
    caps = f"video/x-raw,format=I420,width={WIDTH},height={HEIGHT},framerate={RATE}/1"
    source = f"appsrc name=camera is-live=true do-timestamp=true format=time caps={caps}"
    factory.set_launch(f"( {source} ! {CODINGS[coding]} )")
    factory.set_shared(True)
    factory.connect("media-configure", configured)
    if login:
        guard(server, factory, *login)
    server.get_mount_points().add_factory("/stream", factory)
    if server.attach(None) == 0:
        sys.exit(f"cannot listen at port {port}")
    print(server.get_bound_port(), flush=True)
    GLib.MainLoop().run()


main()
