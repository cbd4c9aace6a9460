"""DDS on loopback only, without multicast, and peers that look like ROS 2 nodes. Import it before `cyclonedds`."""

from __future__ import annotations

import os

LOOPBACK = (
    '<CycloneDDS><Domain Id="any"><General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>'
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    '<MaxAutoParticipantIndex>20</MaxAutoParticipantIndex><Peers><Peer address="127.0.0.1"/></Peers></Discovery>'
    "</Domain></CycloneDDS>"
)
os.environ["CYCLONEDDS_URI"] = LOOPBACK
DOMAIN = 60 + os.getpid() % 100
"""One of its own for each process, so that runs side by side never meet."""
