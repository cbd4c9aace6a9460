#!/usr/bin/env python3
"""One end of a topic of Debian's Cyclone DDS: secured_peer.py write|read LIBRARY DOMAIN TOPIC COUNT; prints JSON.

CYCLONEDDS_URI says who it is. Only the C library has the plugins of DDS security, so it is called by itself.
"""

import ctypes as ct
import json
import os
import sys
import time

# dds_opcodes.h: DDS_OP_ADR | DDS_OP_TYPE_8BY. retcode.h: DDS_RETCODE_NOT_ALLOWED_BY_SECURITY.
EIGHT_BYTES = 0x01 << 24 | 0x04 << 16
DENIED = -13
WAIT_S = 15.0
QUIET_S = 2.0
VALID_AT = 12


class Descriptor(ct.Structure):
    """`dds_topic_descriptor_t` of dds_public_impl.h."""

    _fields_ = [
        *((name, ct.c_uint32) for name in ("size", "align", "flags", "keys")),
        ("name", ct.c_char_p),
        ("key_list", ct.c_void_p),
        ("ops_count", ct.c_uint32),
        ("ops", ct.POINTER(ct.c_uint32)),
        ("meta", ct.c_char_p),
        *((name, ct.c_uint64) for name in ("information", "information_size", "mapping", "mapping_size", "forms")),
    ]


class End:
    def __init__(self, library, domain, topic):
        self.dds = ct.CDLL(library)
        ops = (ct.c_uint32 * 3)(EIGHT_BYTES, 0, 0)
        name = b"geometry_msgs::msg::dds_::Twist_"
        self.kept = Descriptor(size=8, align=8, name=name, ops_count=2, ops=ops, meta=b"")
        self.participant = self.dds.dds_create_participant(domain, None, None)
        if self.participant < 0:
            sys.exit(f"no participant: {self.dds.dds_strretcode(-self.participant)}")
        self.topic = self.dds.dds_create_topic(self.participant, ct.byref(self.kept), topic.encode(), None, None)
        self.qos = ct.c_void_p(self.dds_create_qos())
        self.dds.dds_qset_reliability(self.qos, 1, ct.c_int64(10**9))
        self.dds.dds_qset_history(self.qos, 1, 0)

    def dds_create_qos(self):
        self.dds.dds_create_qos.restype = ct.c_void_p
        return self.dds.dds_create_qos()

    def make(self, kind):
        """The handle of a writer or a reader; the code of an error where there is none."""
        if self.topic < 0:
            return self.topic
        return getattr(self.dds, f"dds_create_{kind}")(self.participant, self.topic, self.qos, None)


def write(end, count):
    writer = end.make("writer")
    if writer < 0:
        return {"denied": writer == DENIED, "sent": 0}
    matched, limit = (ct.c_uint32 * 8)(), time.monotonic() + WAIT_S
    while not matched[2] and time.monotonic() < limit:  # current_count of dds_publication_matched_status_t
        end.dds.dds_get_publication_matched_status(writer, ct.byref(matched))
        time.sleep(0.02)
    for number in range(count):
        end.dds.dds_write(writer, ct.byref(ct.c_double(number)))
        time.sleep(0.005)
    time.sleep(QUIET_S)
    return {"denied": False, "sent": count}


def read(end, count):
    """Until all came, or nothing more comes within the time in which a peer is found."""
    reader = end.make("reader")
    if reader < 0:
        sys.exit(f"no reader: {reader}")
    print("ready", flush=True)
    value, info = ct.c_double(), ct.create_string_buffer(1024)
    place = (ct.c_void_p * 1)(ct.addressof(value))
    got, limit = 0, time.monotonic() + WAIT_S
    while got < count and time.monotonic() < limit:
        taken = end.dds.dds_take(reader, place, info, ct.c_size_t(1), 1)
        got += taken == 1 and info.raw[VALID_AT] == 1
        if taken != 1:
            time.sleep(0.01)
    return {"got": got}


def main():
    what, library, domain, topic, count = sys.argv[1:]
    end = End(library, int(domain), topic)
    print(json.dumps({"write": write, "read": read}[what](end, int(count))), flush=True)
    os._exit(0)  # threads of the library outlive what they use when the interpreter goes first


main()
