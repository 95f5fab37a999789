"""What is raised for input that the specification refuses."""


class BadHeader(Exception):
    """A stream header that is refused; the argument is the reason."""


class BadPacket(Exception):
    """A packet that is refused or corrupt; the argument is the reason."""
