"""A second checker of stored certificates, on balls and exact numbers; see recheck_certificates.py."""


class BadInput(Exception):
    """What cannot be read, with what is accepted."""
