"""Reference decoder of the organised point codec, written after docs/organised-codec.md.

It is meant to be read beside the specification, section by section, and to settle what a packet means;
it is not fast. `read_stream_header` and `decode_packet` are all that a caller needs.
"""
from .errors import BadHeader, BadPacket
from .packet import decode_packet
from .points import Point
from .stream_header import StreamHeader, read_stream_header
from .tables import Tables, load_tables

__all__ = ['BadHeader', 'BadPacket', 'Point', 'StreamHeader', 'Tables', 'decode_packet', 'load_tables',
           'read_stream_header']
