"""Message types, generated from messages/*.h by generate_messages.py: edit those, not this.

Arrays are numpy arrays; received ones are read-only views. docs/manual/messages.md is the reference.
"""
from dataclasses import dataclass

import numpy as np

from ensonify.typed import Message, Struct, array, fixed, list_of

__all__ = [
    "Actuators",
    "Pace",
    "ClockHealth",
    "ConsoleTopic",
    "ConsoleItem",
    "ConsoleScalar",
    "ConsoleType",
    "ConsoleState",
    "ConsoleFlowTopic",
    "ConsoleFlow",
    "ConsoleCells",
    "ConsoleTrack",
    "ConsoleSeries",
    "ConsoleValues",
    "ConsoleAlarm",
    "ConsoleAlarms",
    "ConsoleLogLine",
    "ConsoleLog",
    "ConsoleRelief",
    "ConsoleMark",
    "ConsolePlan",
    "ConsoleEnter",
    "ConsoleWatched",
    "ConsoleWatch",
    "ConsoleDrawn",
    "ConsoleOpen",
    "ConsoleCommand",
    "ConsoleAnswer",
    "SectorDeclaration",
    "SettingDeclaration",
    "ChannelDeclaration",
    "HeadDeclaration",
    "PagerDeclaration",
    "FeedPiece",
    "FeedData",
    "Counter",
    "Health",
    "LabelledObject",
    "Labels",
    "EnergySource",
    "Energies",
    "Mark",
    "NextLine",
    "Coverage",
    "Pose",
    "Guidance",
    "Helm",
    "MissionState",
    "Attitude",
    "Position",
    "SoundSpeed",
    "Estimate",
    "DelayedHeave",
    "Heading",
    "InertialIncrements",
    "VelocityLog",
    "Depth",
    "Altitude",
    "CurrentProfile",
    "Ctd",
    "UsblFix",
    "TransmitSector",
    "AppliedSettings",
    "HeadTrack",
    "Ping",
    "BottomTrack",
    "Transmit",
    "SonarSettings",
    "Soundings",
    "Snippets",
    "SeabedImage",
    "Tile",
    "TileRelease",
    "Mesh",
    "MeshRelease",
    "Object",
    "ObjectMesh",
    "ObjectRelease",
    "Chart",
    "View",
]


@dataclass(eq=False)
class Actuators(Message):
    """What a pilot orders of the propellers and fins of a vehicle that is moved by forces, past its own helm.

    stamp_ns [ns]: time of the order, sim time
    propeller_rps [rev/s]: revolutions of each propeller, ahead positive, in the order of the dynamics file
    fin_rad [rad]: angle of each fin, positive as the dynamics file has its lift, in its order
    vehicle: name of the vehicle that is meant; empty: whichever receives it
    hand_back [1]: release of the vehicle to the next of those who may steer it
    """

    TYPE = "actuators/1"
    stamp_ns: int = 0
    propeller_rps: np.ndarray = array("f8")
    fin_rad: np.ndarray = array("f8")
    vehicle: str = ""
    hand_back: bool = False


@dataclass(eq=False)
class Pace(Struct):
    """Cost of one participant in wall time.

    name: name of the process in the launch file
    grants [1]: grants given to it
    cost_s [s]: wall time inside its events
    late_events [1]: grants that it finished last, the run being late
    worst_lateness_s [s]: largest lateness charged to it, sim time
    """

    name: str = ""
    grants: int = 0
    cost_s: float = 0.0
    late_events: int = 0
    worst_lateness_s: float = 0.0


@dataclass(eq=False)
class ClockHealth(Message):
    """How a run keeps its pace, about once a second of wall time. Wall-clock facts: on the live plane only, never recorded.

    stamp_ns [ns]: sim time that all participants have reached
    state: running or paused
    wall_s [s]: wall time since sim time started
    rate [1]: sim seconds per wall second asked for; 0: as fast as possible
    rate_factor [1]: sim seconds per wall second achieved since the report before
    lateness_s [s]: time that the run stands behind paced time, sim time
    slips [1]: number of times that lost time was given up (slip_after_s)
    slip_s [s]: sim time given up in all
    participants: participants by rank
    """

    TYPE = "clock_health/1"
    stamp_ns: int = 0
    state: str = "running"
    wall_s: float = 0.0
    rate: float = 0.0
    rate_factor: float = 0.0
    lateness_s: float = 0.0
    slips: int = 0
    slip_s: float = 0.0
    participants: list = list_of(Pace)


@dataclass(eq=False)
class ConsoleTopic(Struct):
    """A topic that can be watched.

    name: name of the topic; of a head's pictures HEAD/view
    type: message type
    publisher: process that publishes it
    component: component of the publisher, of a record for heads alone; empty: not known
    """

    name: str = ""
    type: str = ""
    publisher: str = ""
    component: str = ""


@dataclass(eq=False)
class ConsoleItem(Struct):
    """Something that can be opened: a live run or a record.

    id: name by which it is opened
    kind: run or record
    text: line that describes it
    """

    id: str = ""
    kind: str = ""
    text: str = ""


@dataclass(eq=False)
class ConsoleScalar(Struct):
    """A number of a message type that can be drawn over time.

    field: name of the number in its message, with dots where it lies deeper
    unit: unit in which it is sent: degrees for angles
    about: meaning of the number
    """

    field: str = ""
    unit: str = ""
    about: str = ""


@dataclass(eq=False)
class ConsoleType(Struct):
    """Part of a message: ConsoleType.

    type: message type
    scalars: numbers of its messages, and what follows from them
    """

    type: str = ""
    scalars: list = list_of(ConsoleScalar)


@dataclass(eq=False)
class ConsoleState(Message):
    """What a console shows, to its viewers when they enter and when it changes.

    kind: kind of source: run, record, or empty where nothing is open
    name: name of the run or record
    launch: launch file of a run, as far as it is known
    state: waiting, running, paused or ended
    message: why, in one line
    may_control: true where this viewer may pause, resume, set the rate and stop
    exit_code [1]: exit code of a run that has ended and was started by this console
    speed [1]: sim seconds per wall second that are asked for; 0: as fast as possible
    topics: topics that can be watched
    types: types of these topics that have numbers to be drawn over time
    items: live runs and records that can be opened
    launches: launch files of the installation, to be started from a shell
    """

    TYPE = "console_state/1"
    kind: str = ""
    name: str = ""
    launch: str = ""
    state: str = ""
    message: str = ""
    may_control: bool = False
    exit_code: int = 0
    speed: float = 0.0
    topics: list = list_of(ConsoleTopic)
    types: list = list_of(ConsoleType)
    items: list = list_of(ConsoleItem)
    launches: list = list_of(str)


@dataclass(eq=False)
class ConsoleFlowTopic(Struct):
    """How one watched topic reaches a viewer.

    topic: name of the topic
    sent [1]: number of messages sent to this viewer
    lost [1]: number of messages that it was not sent: of pictures those that a newer one replaced
    halved [1]: number of times that its pictures are halved in width for the sake of the link
    rate_hz [Hz]: messages sent per second of wall time since the report before
    age_s [s]: wall time from the arrival of the newest message at the gateway until the viewer had drawn it
    """

    topic: str = ""
    sent: int = 0
    lost: int = 0
    halved: int = 0
    rate_hz: float = 0.0
    age_s: float = 0.0


@dataclass(eq=False)
class ConsoleFlow(Message):
    """How messages reach a viewer, once a second of wall time.

    link_bytes_per_s [B/s]: rate of the link as the last pictures found it; 0: not known
    waiting_bytes [1]: number of bytes that wait for this viewer
    topics: topics that are watched
    """

    TYPE = "console_flow/1"
    link_bytes_per_s: float = 0.0
    waiting_bytes: int = 0
    topics: list = list_of(ConsoleFlowTopic)


@dataclass(eq=False)
class ConsoleCells(Message):
    """Cells of the grid that a console makes of all soundings: those that have changed, with all that fell into them.

    generation [1]: number of the grid; with another one all earlier cells are void
    since_ns [ns]: sim time of the first ping in the grid
    cell_m [m]: side of a cell
    column [1]: column of each cell: its western edge lies at column times cell_m
    row [1]: row of each cell: its southern edge lies at row times cell_m
    count [1]: number of soundings in each cell
    mean_depth_m [m]: mean depth of each cell, positive down from chart datum
    shoalest_depth_m [m]: least depth of each cell
    sd_m [m]: standard deviation of each cell's depths; NaN of fewer than two
    """

    TYPE = "console_cells/1"
    generation: int = 0
    since_ns: int = 0
    cell_m: float = 0.0
    column: np.ndarray = array("i4")
    row: np.ndarray = array("i4")
    count: np.ndarray = array("u4")
    mean_depth_m: np.ndarray = array("f4")
    shoalest_depth_m: np.ndarray = array("f4")
    sd_m: np.ndarray = array("f4")


@dataclass(eq=False)
class ConsoleTrack(Message):
    """Track of a vehicle as it grows: new points, and where the vehicle is now.

    generation [1]: number of the track; with another one all earlier points are void
    source: name of the topic that the track comes from
    truth: true for the true pose, false for an estimate
    stamp_ns [ns]: sim time of the newest position
    position_enu_m [m]: newest position: east, north, up from chart datum
    heading_rad [rad]: newest heading, clockwise from grid north
    first [1]: index of the first of the new points
    point_enu_m [m]: new points (point x 2): east, north; half a metre apart or more
    """

    TYPE = "console_track/1"
    generation: int = 0
    source: str = ""
    truth: bool = False
    stamp_ns: int = 0
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    heading_rad: float = 0.0
    first: int = 0
    point_enu_m: np.ndarray = array("f8")


@dataclass(eq=False)
class ConsoleSeries(Struct):
    """New points of one number.

    name: name of the number: TOPIC.field
    unit: unit of its values; empty: not known
    first [1]: index of the first of the new points
    time_s [s]: sim time of each point
    value: value of each point; NaN: a gap. Of more than ten a second, the least and the greatest of every 0.2 s
    """

    name: str = ""
    unit: str = ""
    first: int = 0
    time_s: np.ndarray = array("f8")
    value: np.ndarray = array("f8")


@dataclass(eq=False)
class ConsoleValues(Message):
    """Numbers over time: new points of those that a viewer asks for.

    generation [1]: number of the run; with another one all earlier points are void
    series: numbers with new points
    """

    TYPE = "console_values/1"
    generation: int = 0
    series: list = list_of(ConsoleSeries)


@dataclass(eq=False)
class ConsoleAlarm(Struct):
    """Something that an operator has to know of.

    kind: no_bottom, off_line, late, late_pings, slips, lost, disk, degraded or failed
    source: name of the process, topic or folder that it is about
    text: cause, in one line
    active: true while its cause lasts; what happens at a moment is never active
    raised [1]: number of times that it was raised; one that is higher needs another acknowledgement
    since_ns [ns]: sim time at which it was raised last
    """

    kind: str = ""
    source: str = ""
    text: str = ""
    active: bool = False
    raised: int = 0
    since_ns: int = 0


@dataclass(eq=False)
class ConsoleAlarms(Message):
    """All alarms of a run, those that have passed as well.

    generation [1]: number of the run; acknowledgements of another one are void
    alarms: alarms, at most 64
    """

    TYPE = "console_alarms/1"
    generation: int = 0
    alarms: list = list_of(ConsoleAlarm)


@dataclass(eq=False)
class ConsoleLogLine(Struct):
    """Part of a message: ConsoleLogLine.

    process: name of the process that wrote it
    level: error, warning or info, by the words of the line
    text: line, at most 500 bytes
    """

    process: str = ""
    level: str = ""
    text: str = ""


@dataclass(eq=False)
class ConsoleLog(Message):
    """New lines of the logs that a run's processes write, the newest last.

    generation [1]: number of the run; with another one all earlier lines are void
    first [1]: index of the first of these lines, of all that were read
    lines: lines
    """

    TYPE = "console_log/1"
    generation: int = 0
    first: int = 0
    lines: list = list_of(ConsoleLogLine)


@dataclass(eq=False)
class ConsoleRelief(Message):
    """The seabed of chart/1 as shaded relief with contours, and where the world lies.

    projection: map of the world's plane, in the words of PROJ: east and north in metres on WGS 84
    west_m [m]: world east of the western posts
    south_m [m]: world north of the southern posts
    spacing_m [m]: distance between posts
    shade [1]: brightness of each post (north x east, south-west first) in light from the north-west, 1 dark to 255 bright; 0: nothing is known
    exaggeration [1]: factor by which slopes are steeper in the shading than they are
    contour_step_m [m]: difference of depth between contours
    contour_depth_m [m]: depth of each piece of a contour, below chart datum
    contour_m [m]: straight pieces of contours (piece x 4): east and north of both ends
    """

    TYPE = "console_relief/1"
    projection: str = ""
    west_m: float = 0.0
    south_m: float = 0.0
    spacing_m: float = 1.0
    shade: np.ndarray = array("u1")
    exaggeration: float = 1.0
    contour_step_m: float = 0.0
    contour_depth_m: np.ndarray = array("f4")
    contour_m: np.ndarray = array("f4")


@dataclass(eq=False)
class ConsoleMark(Struct):
    """A mark on the chart.

    text: description of the mark
    position_enu_m [m]: estimated position of the vehicle then: east, north
    """

    text: str = ""
    position_enu_m: tuple = fixed(0.0, 0.0)


@dataclass(eq=False)
class ConsolePlan(Message):
    """What is planned, and what was marked: for a viewer's chart.

    line_enu_m [m]: runlines in the order run (line x 4): east and north of the start, then of the end
    marks: marks, the oldest first
    """

    TYPE = "console_plan/1"
    line_enu_m: np.ndarray = array("f8")
    marks: list = list_of(ConsoleMark)


@dataclass(eq=False)
class ConsoleEnter(Message):
    """A viewer's first message, within 2 s.

    token: token of the URL to view or to control
    """

    TYPE = "console_enter/1"
    token: str = ""


@dataclass(eq=False)
class ConsoleWatched(Struct):
    """A topic that a viewer watches.

    topic: name of the topic
    cells [1]: most cells of a picture over range, 16 to 1024
    peak: choice of a cell's level: true its strongest sample
    spreading_db [dB]: S of the gain S log10(R) + 2 A R to add for display, 0 to 60
    absorption_dbpm [dB/m]: absorption A of the gain to add, 0 to 1
    """

    topic: str = ""
    cells: int = 1024
    peak: bool = False
    spreading_db: float = 0.0
    absorption_dbpm: float = 0.0


@dataclass(eq=False)
class ConsoleWatch(Message):
    """A viewer says all that it watches from now on.

    hidden: true while nobody can see the page: nothing is sent to it
    topics: topics, at most 64
    values: names of numbers (TOPIC.field) of the topic values, at most 32
    ground: topics of these whose ranges are to lie on the ground, where the head's altitude is known
    """

    TYPE = "console_watch/1"
    hidden: bool = False
    topics: list = list_of(ConsoleWatched)
    values: list = list_of(str)
    ground: list = list_of(str)


@dataclass(eq=False)
class ConsoleDrawn(Message):
    """A viewer has drawn a picture or a line and can take the next.

    topic: name of the topic
    seq [1]: seq of the message's envelope
    """

    TYPE = "console_drawn/1"
    topic: str = ""
    seq: int = 0


@dataclass(eq=False)
class ConsoleOpen(Message):
    """A viewer asks for another run or record.

    id: id of an item of console_state/1
    """

    TYPE = "console_open/1"
    id: str = ""


@dataclass(eq=False)
class ConsoleCommand(Message):
    """A command to the run, from a viewer that came by the URL to control.

    command: pause, resume, rate or stop
    rate [1]: sim seconds per wall second for the command rate; 0: as fast as possible
    """

    TYPE = "console_command/1"
    command: str = ""
    rate: float = 1.0


@dataclass(eq=False)
class ConsoleAnswer(Message):
    """Why something that a viewer asked for was not done.

    request: type of the message that asked
    error: cause and what is allowed
    """

    TYPE = "console_answer/1"
    request: str = ""
    error: str = ""


@dataclass(eq=False)
class SectorDeclaration(Struct):
    """One of the transmissions of a head's channel.

    frequency_hz [Hz]: centre frequency
    delay_s [s]: start after the ping's time of transmission
    """

    frequency_hz: float = 0.0
    delay_s: float = 0.0


@dataclass(eq=False)
class SettingDeclaration(Struct):
    """Limits of one setting of a head.

    setting: field of sonar_settings/1
    least [unit of that field]: least value of a number; equal to the most: it is fixed
    most [unit of that field]: greatest value of a number
    chosen [1]: true where 0 lets the head choose
    words: values of a text; empty for a number
    """

    setting: str = ""
    least: float = 0.0
    most: float = 0.0
    chosen: bool = False
    words: list = list_of(str)


@dataclass(eq=False)
class ChannelDeclaration(Struct):
    """A channel of a head: its transmissions and what a command may set.

    name: end of its ports' names; empty: the only channel
    sectors: transmissions of a ping
    settings: limits of what a command may set; what is not listed cannot be set
    """

    name: str = ""
    sectors: list = list_of(SectorDeclaration)
    settings: list = list_of(SettingDeclaration)


@dataclass(eq=False)
class HeadDeclaration(Message):
    """What a sonar head declares before the run. It is part of `hello` and of a record, and no topic.

    kind: kind of head, as in ping/1
    instrument: class of instruments that the head stands for, such as em2040; empty: none in particular
    beam_axis: axis of the head from which beam angles count, positive to starboard: down or forward
    finest_beam_rad [rad]: half-power width of the finest beam
    near_field_m [m]: range within which the unfocused receive array is in its near field; 0: not stated
    reach_m [m]: distance from the vehicle's origin to which the longest range reaches; 0: it has no range
    auto_range [1]: true where the range follows the depth in every channel
    position_body_m [m]: transducer, as measured: forward, starboard, down
    body_from_head [1]: rotation, as measured: quaternion w, x, y, z
    channels: channels that ping together
    """

    TYPE = "head_declaration/1"
    kind: str = ""
    instrument: str = ""
    beam_axis: str = "down"
    finest_beam_rad: float = 0.0
    near_field_m: float = 0.0
    reach_m: float = 0.0
    auto_range: bool = False
    position_body_m: tuple = fixed(0.0, 0.0, 0.0)
    body_from_head: tuple = fixed(1.0, 0.0, 0.0, 0.0)
    channels: list = list_of(ChannelDeclaration)


@dataclass(eq=False)
class PagerDeclaration(Message):
    """What the terrain pager declares before the run. It is part of `hello` and of a record, and no topic.

    post_spacing_m [m]: distance between posts
    shallowest_m [m]: least depth below chart datum, positive down
    """

    TYPE = "pager_declaration/1"
    post_spacing_m: float = 0.0
    shallowest_m: float = 0.0


@dataclass(eq=False)
class FeedPiece(Struct):
    """Bytes of one source of a feed that came together.

    source: name of the source that sent them
    arrival_ns [ns]: time of their arrival, sim time
    byte_count [1]: number of bytes
    begins: true for the first of a connection
    whole: true for a datagram, which nothing continues
    """

    source: str = ""
    arrival_ns: int = 0
    byte_count: int = 0
    begins: bool = False
    whole: bool = False


@dataclass(eq=False)
class FeedData(Message):
    """Bytes from outside that a feed took at this event, as they came.

    stamp_ns [ns]: time of the event, sim time
    pieces: pieces in the order in which they were taken
    bytes [1]: bytes of all pieces, one after the other
    """

    TYPE = "feed_data/1"
    stamp_ns: int = 0
    pieces: list = list_of(FeedPiece)
    bytes: np.ndarray = array("u1")


@dataclass(eq=False)
class Counter(Struct):
    """Part of a message: Counter.

    name: name of what is counted
    count [1]: number of times since the start
    """

    name: str = ""
    count: int = 0


@dataclass(eq=False)
class Health(Message):
    """How a process is doing, in sim time: published when it changes. Wall-clock facts are the clock's.

    stamp_ns [ns]: time of the report, sim time
    state: ok, degraded or failed
    message: why, in one line
    counters: counts of what happened
    """

    TYPE = "health/1"
    stamp_ns: int = 0
    state: str = "ok"
    message: str = ""
    counters: list = list_of(Counter)


@dataclass(eq=False)
class LabelledObject(Struct):
    """An object that could be in a ping's image.

    instance [1]: number in the world, from 1, of all pings and heads
    name: name in the scenario
    class_name: class
    class_id [1]: number of the class, from 1
    inside [1]: part of the silhouette's solid angle, 0..1, that is within the image
    visible [1]: part of that, 0..1, that nothing hides
    occluded [1]: rest of it, which the seabed or another object hides
    buried [1]: part of the volume that lies below the seabed
    hit_enu_m [m]: middle of the visible surface, world position
    range_m [m]: distance from the head at transmission to that middle
    grazing_rad [rad]: grazing angle, mean over the visible surface
    aspect_rad [rad]: bearing of the head from the object, clockwise from its own north
    sediment [1]: sediment class by whose law it scatters
    smooth: smoothness: its echo follows from its shape
    box [1]: box round its mask: first beam, first sample, beam and sample after the last; all 0: no mask
    shadow_box [1]: box round its shadow, of the same form; all 0: no shadow
    """

    instance: int = 0
    name: str = ""
    class_name: str = ""
    class_id: int = 0
    inside: float = 0.0
    visible: float = 0.0
    occluded: float = 0.0
    buried: float = 0.0
    hit_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    range_m: float = 0.0
    grazing_rad: float = 0.0
    aspect_rad: float = 0.0
    sediment: int = 0
    smooth: bool = False
    box: tuple = fixed(0, 0, 0, 0)
    shadow_box: tuple = fixed(0, 0, 0, 0)


@dataclass(eq=False)
class Labels(Message):
    """What is where in the image of a ping: masks and shadows of objects. Truth. Sample k stands for times of half a sample period about its own.

    stamp_ns [ns]: time of transmission, sim time, as of the ping
    ping [1]: ping number of this head, as of the ping
    beams [1]: rows of the image
    samples [1]: columns of the image
    objects: objects within the range and the head's view, by instance
    mask_run [1]: runs (run x 4) of the objects' own masks, which may overlap: place in objects, beam, first sample, sample after the last
    layer_run [1]: runs (run x 4) of one mask of all: where several overlap, the one that sends most
    shadow_run [1]: runs (run x 4) of shadows: place in objects of what casts it, -1: the seabed itself; beam, first sample, sample after the last
    shadow_db [dB]: depth of the shadow at each sample of the runs, one after the other: what the seabed would send there without objects over what it sends, at most 60; 0 of the seabed's own
    """

    TYPE = "labels/1"
    stamp_ns: int = 0
    ping: int = 0
    beams: int = 0
    samples: int = 0
    objects: list = list_of(LabelledObject)
    mask_run: np.ndarray = array("i4")
    layer_run: np.ndarray = array("i4")
    shadow_run: np.ndarray = array("i4")
    shadow_db: np.ndarray = array("u1")


@dataclass(eq=False)
class EnergySource(Struct):
    """Source of sound in a ping.

    kind: kind of source: noise, volume (the water), interference (other heads and sectors), surface, seabed or object
    path: way of the sound: direct, surface (out or back by way of it) or bottom (by way of both)
    instance [1]: number of the object in the world, from 1; 0: none
    name: name of the object in the scenario
    class_name: class of the object
    class_id [1]: number of the object's class, from 1; 0: no object
    sediment [1]: sediment class, of the seabed or of what the object scatters as
    """

    kind: str = ""
    path: str = ""
    instance: int = 0
    name: str = ""
    class_name: str = ""
    class_id: int = 0
    sediment: int = 0


@dataclass(eq=False)
class Energies(Message):
    """Who sends how much of each sample of a ping, expected over all draws of speckle and noise. Truth.

    stamp_ns [ns]: time of transmission, sim time, as of the ping
    ping [1]: ping number of this head, as of the ping
    beams [1]: rows of the image
    samples [1]: columns of the image
    first_sample_s [s]: time of the first sample after transmission, as of the ping
    sample_period_s [s]: time between samples
    sources: sources of sound; the first is noise, and of equals the earlier counts as the stronger
    run [1]: runs (run x 4) of what sources send: place in sources, beam, first sample, sample after the last. What is less than a millionth of a sample is left out
    energy_upa2 [uPa^2]: mean square at each sample of the runs, one after the other
    """

    TYPE = "energies/1"
    stamp_ns: int = 0
    ping: int = 0
    beams: int = 0
    samples: int = 0
    first_sample_s: float = 0.0
    sample_period_s: float = 0.0
    sources: list = list_of(EnergySource)
    run: np.ndarray = array("i4")
    energy_upa2: np.ndarray = array("f4")


@dataclass(eq=False)
class Mark(Message):
    """Something worth finding again, as a mission or an agent notes it.

    stamp_ns [ns]: time of the mark, sim time
    text: description of the mark
    position_enu_m [m]: estimated position of the vehicle then: east, north, up
    """

    TYPE = "mark/1"
    stamp_ns: int = 0
    text: str = ""
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)


@dataclass(eq=False)
class NextLine(Message):
    """The line that an adaptive survey is to run next.

    stamp_ns [ns]: time of the decision, sim time
    number [1]: index of the line in the survey, the first is 0 and known beforehand
    done: true when nothing is left to run; the line means nothing then
    start_enu_m [m]: start of the line: east, north
    end_enu_m [m]: end of the line: east, north
    """

    TYPE = "next_line/1"
    stamp_ns: int = 0
    number: int = 0
    done: bool = False
    start_enu_m: tuple = fixed(0.0, 0.0)
    end_enu_m: tuple = fixed(0.0, 0.0)


@dataclass(eq=False)
class Coverage(Message):
    """What soundings have covered so far, by estimate: cells of a rectangle.

    stamp_ns [ns]: time of validity, sim time
    lines [1]: number of lines run
    corner_enu_m [m]: the rectangle's rear port corner: east, north
    heading_grid_rad [rad]: forward along the rectangle, clockwise from grid north
    cell_m [m]: side of a cell
    needed [1]: accepted soundings that a covered cell has at least
    covered [1]: share of the cells that are covered
    overlapped [1]: redundancy: how often a covered cell was covered, by lines, on average
    track_m [m]: length of all lines run, without turns
    elapsed_s [s]: time from the first sounding to the last
    soundings [1]: accepted soundings of each cell (starboard x forward), as far as it can count
    height_m [m]: mean height of each cell's accepted soundings, up from chart datum; NaN: none
    """

    TYPE = "coverage/1"
    stamp_ns: int = 0
    lines: int = 0
    corner_enu_m: tuple = fixed(0.0, 0.0)
    heading_grid_rad: float = 0.0
    cell_m: float = 1.0
    needed: int = 1
    covered: float = 0.0
    overlapped: float = 0.0
    track_m: float = 0.0
    elapsed_s: float = 0.0
    soundings: np.ndarray = array("u2")
    height_m: np.ndarray = array("f4")


@dataclass(eq=False)
class Pose(Message):
    """Where a vehicle truly is. Truth: acoustics uses it, instruments and records of instruments never do.

    stamp_ns [ns]: time of validity, sim time
    position_enu_m [m]: body origin in the world frame: east, north, up from chart datum
    enu_from_body [1]: attitude quaternion w, x, y, z (w >= 0) from body FRD to world ENU
    velocity_enu_mps [m/s]: velocity of the body origin in the world frame
    rate_body_radps [rad/s]: angular rate in the body frame, FRD
    acceleration_enu_mps2 [m/s^2]: acceleration of the body origin in the world frame; less gravity, turned to the body, it is the specific force
    angular_acceleration_body_radps2 [rad/s^2]: rate of the angular rate, body frame
    """

    TYPE = "pose/1"
    stamp_ns: int = 0
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    enu_from_body: tuple = fixed(1.0, 0.0, 0.0, 0.0)
    velocity_enu_mps: tuple = fixed(0.0, 0.0, 0.0)
    rate_body_radps: tuple = fixed(0.0, 0.0, 0.0)
    acceleration_enu_mps2: tuple = fixed(0.0, 0.0, 0.0)
    angular_acceleration_body_radps2: tuple = fixed(0.0, 0.0, 0.0)


@dataclass(eq=False)
class Guidance(Message):
    """What a pilot (autopilot or agent) asks of a vehicle.

    stamp_ns [ns]: time of the command, sim time
    heading_grid_rad [rad]: heading to steer, clockwise from grid north
    speed_mps [m/s]: speed through the water to reach, forward
    depth_m [m]: depth of the body origin below the water level to hold; NaN: as before
    vehicle: name of the vehicle that is meant; empty: whichever receives it
    hand_back [1]: release of the vehicle to the next of those who may steer it
    """

    TYPE = "guidance/1"
    stamp_ns: int = 0
    heading_grid_rad: float = 0.0
    speed_mps: float = 0.0
    depth_m: float = float("nan")
    vehicle: str = ""
    hand_back: bool = False


@dataclass(eq=False)
class Helm(Message):
    """Who steers a vehicle, of several that may, and why.

    stamp_ns [ns]: time of the state, sim time
    steered_by: name of the pilot whose commands are obeyed; empty: nobody's
    pilots: names of those who may steer it, the first before the others
    why: reason of the last change: commands, silent, hand_back; empty: none yet
    refused [1]: number of commands refused so far, of all pilots
    """

    TYPE = "helm/1"
    stamp_ns: int = 0
    steered_by: str = ""
    pilots: list = list_of(str)
    why: str = ""
    refused: int = 0


@dataclass(eq=False)
class MissionState(Message):
    """What the mission is doing.

    stamp_ns [ns]: time of the state, sim time
    state: run_in, on_line, run_out or turn; pass, keep or orbit; await_line; stand_by; abort or done
    line [1]: index of the runline being run, -1 before the first
    line_count [1]: number of runlines in the mission
    line_name: name of the runline being run; empty: it has none
    cross_track_m [m]: estimated distance right of the runline, positive to starboard
    distance_to_go_m [m]: distance to the end of the runline
    """

    TYPE = "mission_state/1"
    stamp_ns: int = 0
    state: str = ""
    line: int = -1
    line_count: int = 0
    line_name: str = ""
    cross_track_m: float = 0.0
    distance_to_go_m: float = 0.0


@dataclass(eq=False)
class Attitude(Message):
    """What the motion sensor and gyro report.

    stamp_ns [ns]: time of measurement, sim time
    roll_rad [rad]: roll, positive starboard down
    pitch_rad [rad]: pitch, positive bow up
    heading_grid_rad [rad]: heading, clockwise from grid north
    heave_m [m]: vertical displacement from the mean level, positive up
    """

    TYPE = "attitude/1"
    stamp_ns: int = 0
    roll_rad: float = 0.0
    pitch_rad: float = 0.0
    heading_grid_rad: float = 0.0
    heave_m: float = 0.0


@dataclass(eq=False)
class Position(Message):
    """What the positioning system reports, referred to the body origin.

    stamp_ns [ns]: time of measurement, sim time
    position_enu_m [m]: measured body origin in the world frame: east, north, up
    latitude_deg [deg]: geodetic latitude of the position, WGS 84, positive north
    longitude_deg [deg]: longitude of the position, WGS 84, positive east
    sigma_horizontal_m [m]: stated standard deviation, each horizontal axis
    sigma_vertical_m [m]: stated standard deviation, up
    quality [1]: quality as in NMEA's GGA: 1 single, 2 differential, 4 RTK fixed, 5 RTK float; 0 not given
    hdop [1]: horizontal dilution of precision; 0 not given
    height_above_geoid_m [m]: height of the body origin, as in NMEA's GGA
    geoid_above_ellipsoid_m [m]: undulation of the geoid at the position, WGS 84, as in NMEA's GGA
    """

    TYPE = "position/1"
    stamp_ns: int = 0
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    latitude_deg: float = 0.0
    longitude_deg: float = 0.0
    sigma_horizontal_m: float = 0.0
    sigma_vertical_m: float = 0.0
    quality: int = 0
    hdop: float = 0.0
    height_above_geoid_m: float = 0.0
    geoid_above_ellipsoid_m: float = 0.0


@dataclass(eq=False)
class SoundSpeed(Message):
    """What the sound speed probe at the transducers' faces reports.

    stamp_ns [ns]: time of measurement, sim time
    sound_speed_mps [m/s]: measured speed of sound in the water at the probe
    """

    TYPE = "sound_speed/1"
    stamp_ns: int = 0
    sound_speed_mps: float = 0.0


@dataclass(eq=False)
class Estimate(Message):
    """The navigation estimate: what autopilot, agents and records use for where the vehicle is.

    stamp_ns [ns]: time of validity, sim time
    position_enu_m [m]: estimated body origin in the world frame: east, north, up
    enu_from_body [1]: estimated attitude quaternion w, x, y, z (w >= 0), body FRD to ENU
    velocity_enu_mps [m/s]: estimated velocity of the body origin
    position_covariance_enu_m2 [m2]: covariance of the position's error, row by row; all zero: not given
    velocity_covariance_enu_m2ps2 [m2/s2]: covariance of the velocity, row by row: east, north, up
    rotation_covariance_enu_rad2 [rad2]: covariance of the small rotation about east, north, up from estimate to truth, row by row
    """

    TYPE = "estimate/1"
    stamp_ns: int = 0
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    enu_from_body: tuple = fixed(1.0, 0.0, 0.0, 0.0)
    velocity_enu_mps: tuple = fixed(0.0, 0.0, 0.0)
    position_covariance_enu_m2: tuple = fixed(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    velocity_covariance_enu_m2ps2: tuple = fixed(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    rotation_covariance_enu_rad2: tuple = fixed(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@dataclass(eq=False)
class DelayedHeave(Message):
    """What the motion sensor reports of heave once it knows what came after.

    stamp_ns [ns]: time of the heave, long before the message
    heave_m [m]: vertical displacement from the mean level, positive up
    """

    TYPE = "delayed_heave/1"
    stamp_ns: int = 0
    heave_m: float = 0.0


@dataclass(eq=False)
class Heading(Message):
    """What a compass reports.

    stamp_ns [ns]: time of measurement, by the instrument's clock
    heading_true_rad [rad]: heading, clockwise from true north
    """

    TYPE = "heading/1"
    stamp_ns: int = 0
    heading_true_rad: float = 0.0


@dataclass(eq=False)
class InertialIncrements(Message):
    """What an inertial measurement unit reports: integrals of what it senses.

    stamp_ns [ns]: end of the interval, sim time
    interval_s [s]: interval that is integrated over
    angle_rad [rad]: turn rate against inertial space, integrated, along the unit's axes
    velocity_mps [m/s]: specific force, integrated, along the unit's axes
    """

    TYPE = "inertial_increments/1"
    stamp_ns: int = 0
    interval_s: float = 0.0
    angle_rad: tuple = fixed(0.0, 0.0, 0.0)
    velocity_mps: tuple = fixed(0.0, 0.0, 0.0)


@dataclass(eq=False)
class VelocityLog(Message):
    """What a Doppler log reports.

    stamp_ns [ns]: time of measurement, by the instrument's clock
    bottom_lock: true when velocity is known over ground; else it is zero
    velocity_body_mps [m/s]: velocity of the transducer over ground, turned to the body's axes as mounting was measured
    sigma_body_mps [m/s]: stated standard deviation of each
    range_m [m]: along each beam to the bottom; 0: no lock
    altitude_m [m]: altitude of the transducer above the bottom; 0: no beam has lock
    error_velocity_mps [m/s]: difference in which four beams disagree
    water_lock: true when velocity is known through the water; else it is zero
    water_velocity_body_mps [m/s]: velocity of the transducer through the water that is tracked, along the body's axes as mounting was measured
    """

    TYPE = "velocity_log/1"
    stamp_ns: int = 0
    bottom_lock: bool = False
    velocity_body_mps: tuple = fixed(0.0, 0.0, 0.0)
    sigma_body_mps: tuple = fixed(0.0, 0.0, 0.0)
    range_m: tuple = fixed(0.0, 0.0, 0.0, 0.0)
    altitude_m: float = 0.0
    error_velocity_mps: float = 0.0
    water_lock: bool = False
    water_velocity_body_mps: tuple = fixed(0.0, 0.0, 0.0)


@dataclass(eq=False)
class Depth(Message):
    """What a pressure sensor makes of its depth.

    stamp_ns [ns]: time of measurement, by the instrument's clock
    depth_m [m]: depth of the sensor below the water level
    """

    TYPE = "depth/1"
    stamp_ns: int = 0
    depth_m: float = 0.0


@dataclass(eq=False)
class Altitude(Message):
    """What an altimeter measures: distance to the bottom.

    stamp_ns [ns]: time of measurement, by the instrument's clock
    valid: true when anything answered
    range_m [m]: along the beam to the bottom; 0: no answer
    """

    TYPE = "altitude/1"
    stamp_ns: int = 0
    valid: bool = False
    range_m: float = 0.0


@dataclass(eq=False)
class CurrentProfile(Message):
    """What a current profiler measures: how water of each bin passes it.

    stamp_ns [ns]: time of measurement, by the instrument's clock
    below_transducer_m [m]: bins: distance of each bin's middle along the instrument's axis, rising
    velocity_body_mps [m/s]: bins x 3: of the water less the transducer's, along the body's axes as mounting was measured
    sigma_mps [m/s]: bins: stated standard deviation of each horizontal component
    """

    TYPE = "current_profile/1"
    stamp_ns: int = 0
    below_transducer_m: np.ndarray = array("f8")
    velocity_body_mps: np.ndarray = array("f8")
    sigma_mps: np.ndarray = array("f8")


@dataclass(eq=False)
class Ctd(Message):
    """What a probe of conductivity, temperature and depth makes of the water.

    stamp_ns [ns]: time of measurement, by the instrument's clock
    depth_m [m]: depth of the probe below the water level
    temperature_degc [degC]: temperature of the water
    salinity_psu [psu]: practical salinity of the water
    sound_speed_mps [m/s]: computed from the three before
    """

    TYPE = "ctd/1"
    stamp_ns: int = 0
    depth_m: float = 0.0
    temperature_degc: float = 0.0
    salinity_psu: float = 0.0
    sound_speed_mps: float = 0.0


@dataclass(eq=False)
class UsblFix(Message):
    """Where an ultra-short baseline system finds another vehicle's transponder.

    stamp_ns [ns]: time that the place belongs to, by the instrument's clock
    valid: true when the transponder replied; else the rest is zero
    range_m [m]: range from array to transponder, by the sound speed that the system uses
    place_body_m [m]: transponder less array, along the carrier's body axes as mounting was measured
    position_enu_m [m]: transponder in the world frame, by the carrier's own estimate
    sigma_enu_m [m]: stated standard deviation of each, of the array's measurement alone
    """

    TYPE = "usbl_fix/1"
    stamp_ns: int = 0
    valid: bool = False
    range_m: float = 0.0
    place_body_m: tuple = fixed(0.0, 0.0, 0.0)
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    sigma_enu_m: tuple = fixed(0.0, 0.0, 0.0)


@dataclass(eq=False)
class TransmitSector(Struct):
    """One of the transmissions that a ping consists of, where heads send several side by side or one after the other.

    frequency_hz [Hz]: centre frequency
    pulse: pulse shape of the ping
    pulse_length_s [s]: pulse length
    bandwidth_hz [Hz]: band that an fm pulse sweeps, 0 for cw
    source_level_db [dB re 1 uPa^2 at 1 m]: source level on the axis, rms
    tilt_rad [rad]: steering from the head's athwartships plane, positive forward
    delay_s [s]: start after the ping's time of transmission
    focus_range_m [m]: range of the transmit focus, 0: not focused
    """

    frequency_hz: float = 0.0
    pulse: str = "cw"
    pulse_length_s: float = 0.0
    bandwidth_hz: float = 0.0
    source_level_db: float = 0.0
    tilt_rad: float = 0.0
    delay_s: float = 0.0
    focus_range_m: float = 0.0


@dataclass(eq=False)
class AppliedSettings(Struct):
    """The settings that a ping was made with. In a message they stand beside its other fields.

    frequency_hz [Hz]: centre frequency in force
    pulse: cw (rectangular), cw_tapered, fm_up or fm_down
    pulse_length_s [s]: pulse length in force
    tapered_fraction [1]: part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others
    bandwidth_hz [Hz]: band that an fm pulse sweeps, 0 for cw
    source_level_db [dB re 1 uPa^2 at 1 m]: source level in force, on the axis, rms
    range_m [m]: range setting in force
    ping_rate_hz [Hz]: highest ping rate that is set
    swath_rad [rad]: full angle that the beams are spread over
    mode: operating mode, in the words of the head's documentation
    gain_spreading_db [dB]: S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed
    gain_absorption_dbpm [dB/m]: operator's absorption: A of the gain S log10(R) + 2 A R + O
    gain_offset_db [dB]: offset: O of the gain S log10(R) + 2 A R + O
    transmit_beamwidth_rad [rad]: along-track, one-way, -3 dB
    receive_beamwidth_rad [rad]: across-track, -3 dB, not steered
    roll_stabilised: beams are steered against the measured roll
    pitch_stabilised: the transmission is steered against the measured pitch
    yaw_stabilised: the transmission is steered against the measured yaw
    sound_speed_mps [m/s]: sound speed at the face as the head knows it: it steers the beams
    sectors: transmit sectors; empty: a single one with the values above, straight, at once
    """

    frequency_hz: float = 0.0
    pulse: str = "cw"
    pulse_length_s: float = 0.0
    tapered_fraction: float = 0.0
    bandwidth_hz: float = 0.0
    source_level_db: float = 0.0
    range_m: float = 0.0
    ping_rate_hz: float = 0.0
    swath_rad: float = 0.0
    mode: str = ""
    gain_spreading_db: float = 0.0
    gain_absorption_dbpm: float = 0.0
    gain_offset_db: float = 0.0
    transmit_beamwidth_rad: float = 0.0
    receive_beamwidth_rad: float = 0.0
    roll_stabilised: bool = False
    pitch_stabilised: bool = False
    yaw_stabilised: bool = False
    sound_speed_mps: float = 0.0
    sectors: list = list_of(TransmitSector)


@dataclass(eq=False)
class HeadTrack(Struct):
    """Track of the head, as the instrument knows it: the navigation estimate and the measured mounting. Never the truth. In a message it stands beside its other fields.

    pose_time_s [s]: times after transmission of the poses; the first is 0: the pose at transmission
    pose_position_enu_m [m]: estimated place of the head (time x 3): east, north, up from chart datum, by the measured mounting
    pose_enu_from_head [1]: estimated attitude of the head (time x 4): quaternion w, x, y, z, head FRD to ENU
    """

    pose_time_s: np.ndarray = array("f8")
    pose_position_enu_m: np.ndarray = array("f8")
    pose_enu_from_head: np.ndarray = array("f8")


@dataclass(eq=False)
class Ping(Message):
    """What one transmission brought back, for any head.

    stamp_ns [ns]: time of transmission, sim time
    ping [1]: ping number of this head, from 0
    kind: component that made it, such as multibeam or sidescan; empty: not given
    sample_period_s [s]: time between samples
    first_sample_s [s]: time of the first sample after transmission
    beam_angle_rad [rad]: receive beam axes of this ping in the head frame, positive to starboard: from its down axis, of heads that look forward (forward_looking, scanning) from its forward axis
    amplitude_upa [uPa]: rms pressure amplitude at the receiver (beam x sample), linear, the gain taken out again
    beam_sector [1]: index of each beam's transmit sector; empty: 0
    amplitude_count [1]: digitised amplitude (beam x sample) instead of amplitude_upa, linear, the gain still in it
    count_upa [uPa]: amplitude at the receiver of one count where the gain is 0 dB
    phase_rad [rad]: phase (beam x sample) of the starboard half of the receive array over the port half, -pi..pi, about the beam axis; empty: not formed
    frequency_hz [Hz]: centre frequency in force
    pulse: cw (rectangular), cw_tapered, fm_up or fm_down
    pulse_length_s [s]: pulse length in force
    tapered_fraction [1]: part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others
    bandwidth_hz [Hz]: band that an fm pulse sweeps, 0 for cw
    source_level_db [dB re 1 uPa^2 at 1 m]: source level in force, on the axis, rms
    range_m [m]: range setting in force
    ping_rate_hz [Hz]: highest ping rate that is set
    swath_rad [rad]: full angle that the beams are spread over
    mode: operating mode, in the words of the head's documentation
    gain_spreading_db [dB]: S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed
    gain_absorption_dbpm [dB/m]: operator's absorption: A of the gain S log10(R) + 2 A R + O
    gain_offset_db [dB]: offset: O of the gain S log10(R) + 2 A R + O
    transmit_beamwidth_rad [rad]: along-track, one-way, -3 dB
    receive_beamwidth_rad [rad]: across-track, -3 dB, not steered
    roll_stabilised: beams are steered against the measured roll
    pitch_stabilised: the transmission is steered against the measured pitch
    yaw_stabilised: the transmission is steered against the measured yaw
    sound_speed_mps [m/s]: sound speed at the face as the head knows it: it steers the beams
    sectors: transmit sectors; empty: a single one with the values above, straight, at once
    pose_time_s [s]: times after transmission of the poses; the first is 0: the pose at transmission
    pose_position_enu_m [m]: estimated place of the head (time x 3): east, north, up from chart datum, by the measured mounting
    pose_enu_from_head [1]: estimated attitude of the head (time x 4): quaternion w, x, y, z, head FRD to ENU
    """

    TYPE = "ping/1"
    stamp_ns: int = 0
    ping: int = 0
    kind: str = ""
    sample_period_s: float = 0.0
    first_sample_s: float = 0.0
    beam_angle_rad: np.ndarray = array("f4")
    amplitude_upa: np.ndarray = array("f4")
    beam_sector: np.ndarray = array("u1")
    amplitude_count: np.ndarray = array("u2")
    count_upa: float = 0.0
    phase_rad: np.ndarray = array("f4")
    frequency_hz: float = 0.0
    pulse: str = "cw"
    pulse_length_s: float = 0.0
    tapered_fraction: float = 0.0
    bandwidth_hz: float = 0.0
    source_level_db: float = 0.0
    range_m: float = 0.0
    ping_rate_hz: float = 0.0
    swath_rad: float = 0.0
    mode: str = ""
    gain_spreading_db: float = 0.0
    gain_absorption_dbpm: float = 0.0
    gain_offset_db: float = 0.0
    transmit_beamwidth_rad: float = 0.0
    receive_beamwidth_rad: float = 0.0
    roll_stabilised: bool = False
    pitch_stabilised: bool = False
    yaw_stabilised: bool = False
    sound_speed_mps: float = 0.0
    sectors: list = list_of(TransmitSector)
    pose_time_s: np.ndarray = array("f8")
    pose_position_enu_m: np.ndarray = array("f8")
    pose_enu_from_head: np.ndarray = array("f8")


@dataclass(eq=False)
class BottomTrack(Message):
    """The first bottom return of a head, by its own echoes: what a slant range is corrected with. Never the truth.

    stamp_ns [ns]: time of transmission, sim time
    ping [1]: ping number of this head, from 0
    valid: true when the bottom was found; the rest means nothing if not
    travel_time_s [s]: two-way time of the first bottom return, over all beams and smoothed
    altitude_m [m]: altitude: half of the two-way time at the head's sound speed
    quality_db [dB]: step of the level at the return, over the water column's
    sound_speed_mps [m/s]: sound speed that the head used
    beam_travel_time_s [s]: first bottom return of each beam (sidescan: port, starboard), NaN: none
    """

    TYPE = "bottom_track/1"
    stamp_ns: int = 0
    ping: int = 0
    valid: bool = False
    travel_time_s: float = 0.0
    altitude_m: float = 0.0
    quality_db: float = 0.0
    sound_speed_mps: float = 0.0
    beam_travel_time_s: np.ndarray = array("f4")


@dataclass(eq=False)
class Transmit(Message):
    """A head transmitted: other heads may receive it.

    stamp_ns [ns]: time of transmission, sim time; of a sector that is sent later in the ping, its own
    ping [1]: ping number of this head, from 0; equal for all sectors of a ping
    frequency_hz [Hz]: centre frequency
    pulse_length_s [s]: pulse length
    bandwidth_hz [Hz]: band that an fm pulse sweeps, 0 for cw
    source_level_db [dB re 1 uPa^2 at 1 m]: source level on the axis, rms
    next_ns [ns]: sim time at which the head intends to transmit next; 0: unknown
    """

    TYPE = "transmit/1"
    stamp_ns: int = 0
    ping: int = 0
    frequency_hz: float = 0.0
    pulse_length_s: float = 0.0
    bandwidth_hz: float = 0.0
    source_level_db: float = 0.0
    next_ns: int = 0


@dataclass(eq=False)
class SonarSettings(Message):
    """A command to a head: settings from its next ping on. NaN or empty text leaves a setting as it is.

    stamp_ns [ns]: time of the command, sim time
    range_m [m]: range of reception; 0: the head chooses, where it can
    source_level_db [dB re 1 uPa^2 at 1 m]: source level on the axis, rms
    pulse_length_s [s]: pulse length; 0: the head chooses, where it can
    gain_spreading_db [dB]: S of the gain S log10(R) + 2 A R + O at range R in m
    gain_absorption_dbpm [dB/m]: operator's absorption: A of the gain S log10(R) + 2 A R + O
    gain_offset_db [dB]: offset: O of the gain S log10(R) + 2 A R + O
    swath_rad [rad]: full angle to spread the beams over
    ping_rate_hz [Hz]: highest ping rate
    mode: operating mode, in the words of the head's documentation
    """

    TYPE = "sonar_settings/1"
    stamp_ns: int = 0
    range_m: float = float("nan")
    source_level_db: float = float("nan")
    pulse_length_s: float = float("nan")
    gain_spreading_db: float = float("nan")
    gain_absorption_dbpm: float = float("nan")
    gain_offset_db: float = float("nan")
    swath_rad: float = float("nan")
    ping_rate_hz: float = float("nan")
    mode: str = ""


@dataclass(eq=False)
class Soundings(Message):
    """What the head made of a ping: one entry per beam, or one per detection where `beam` is given. Positions use the estimated pose and the measured mounting.

    stamp_ns [ns]: time of transmission, sim time
    ping [1]: ping number of this head, from 0
    sample_period_s [s]: time between the samples that detection used
    beam [1]: index of each entry's beam, rising; empty: entry i is beam i
    detection [1]: number of the detection within its beam, from 0, the first return first; empty: 0
    sector [1]: index of each entry's transmit sector; empty: 0
    beam_angle_rad [rad]: receive beam axes in the head frame, positive to starboard
    travel_time_s [s]: two-way travel time of the detection
    backscatter_db [dB]: level of the detection re 1 uPa, uncorrected
    backscatter_strength_db [dB]: backscattering strength re 1 m^2 per m^2 that the head makes of the level: by its settings, on a flat seabed; empty: not computed
    quality_db [dB]: signal to noise ratio of the detection
    range_sd_m [m]: predicted standard deviation of the range, sonar only; empty: not predicted
    angle_sd_rad [rad]: predicted standard deviation of the angle, sonar only; empty: not predicted
    window_s [s]: length of the window that the detection used; empty: not given
    kind [1]: 1 by amplitude, 2 by phase (of a blend, the one that weighs more), 0 neither; empty: 1
    flags [1]: why an entry is not valid, added up: 1 weak, 2 cut off by the range, 4 out of the gate, 8 uncertain, 16 side lobe; empty: not given
    valid [1]: 1 where the beam has a sounding; where 0, position_enu_m is NaN, and so is what was not measured
    position_enu_m [m]: sounding (beam x 3): east, north, up from chart datum, by estimate and measured mounting
    tvu_m [m]: predicted total vertical uncertainty of position_enu_m: 95 % of the errors are within; empty: not given
    thu_m [m]: stated 95 % of the horizontal error, as a radius; empty: not given
    frequency_hz [Hz]: centre frequency in force
    pulse: cw (rectangular), cw_tapered, fm_up or fm_down
    pulse_length_s [s]: pulse length in force
    tapered_fraction [1]: part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others
    bandwidth_hz [Hz]: band that an fm pulse sweeps, 0 for cw
    source_level_db [dB re 1 uPa^2 at 1 m]: source level in force, on the axis, rms
    range_m [m]: range setting in force
    ping_rate_hz [Hz]: highest ping rate that is set
    swath_rad [rad]: full angle that the beams are spread over
    mode: operating mode, in the words of the head's documentation
    gain_spreading_db [dB]: S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed
    gain_absorption_dbpm [dB/m]: operator's absorption: A of the gain S log10(R) + 2 A R + O
    gain_offset_db [dB]: offset: O of the gain S log10(R) + 2 A R + O
    transmit_beamwidth_rad [rad]: along-track, one-way, -3 dB
    receive_beamwidth_rad [rad]: across-track, -3 dB, not steered
    roll_stabilised: beams are steered against the measured roll
    pitch_stabilised: the transmission is steered against the measured pitch
    yaw_stabilised: the transmission is steered against the measured yaw
    sound_speed_mps [m/s]: sound speed at the face as the head knows it: it steers the beams
    sectors: transmit sectors; empty: a single one with the values above, straight, at once
    pose_time_s [s]: times after transmission of the poses; the first is 0: the pose at transmission
    pose_position_enu_m [m]: estimated place of the head (time x 3): east, north, up from chart datum, by the measured mounting
    pose_enu_from_head [1]: estimated attitude of the head (time x 4): quaternion w, x, y, z, head FRD to ENU
    """

    TYPE = "soundings/1"
    stamp_ns: int = 0
    ping: int = 0
    sample_period_s: float = 0.0
    beam: np.ndarray = array("u2")
    detection: np.ndarray = array("u1")
    sector: np.ndarray = array("u1")
    beam_angle_rad: np.ndarray = array("f4")
    travel_time_s: np.ndarray = array("f4")
    backscatter_db: np.ndarray = array("f4")
    backscatter_strength_db: np.ndarray = array("f4")
    quality_db: np.ndarray = array("f4")
    range_sd_m: np.ndarray = array("f4")
    angle_sd_rad: np.ndarray = array("f4")
    window_s: np.ndarray = array("f4")
    kind: np.ndarray = array("u1")
    flags: np.ndarray = array("u1")
    valid: np.ndarray = array("u1")
    position_enu_m: np.ndarray = array("f8")
    tvu_m: np.ndarray = array("f4")
    thu_m: np.ndarray = array("f4")
    frequency_hz: float = 0.0
    pulse: str = "cw"
    pulse_length_s: float = 0.0
    tapered_fraction: float = 0.0
    bandwidth_hz: float = 0.0
    source_level_db: float = 0.0
    range_m: float = 0.0
    ping_rate_hz: float = 0.0
    swath_rad: float = 0.0
    mode: str = ""
    gain_spreading_db: float = 0.0
    gain_absorption_dbpm: float = 0.0
    gain_offset_db: float = 0.0
    transmit_beamwidth_rad: float = 0.0
    receive_beamwidth_rad: float = 0.0
    roll_stabilised: bool = False
    pitch_stabilised: bool = False
    yaw_stabilised: bool = False
    sound_speed_mps: float = 0.0
    sectors: list = list_of(TransmitSector)
    pose_time_s: np.ndarray = array("f8")
    pose_position_enu_m: np.ndarray = array("f8")
    pose_enu_from_head: np.ndarray = array("f8")


@dataclass(eq=False)
class Snippets(Message):
    """The amplitudes around each detection, uncorrected: as received, no law taken out.

    stamp_ns [ns]: time of transmission, sim time
    ping [1]: ping number of this head, from 0
    sample_period_s [s]: time between samples
    beam [1]: index of each snippet's beam, rising; beams without a detection have none
    first_sample_s [s]: time of each snippet's first sample after transmission
    centre [1]: sample of the detection, counted from its snippet's first
    offset [1]: start of each snippet in amplitude_upa, and last the number of all samples
    amplitude_upa [uPa]: rms pressure amplitudes at the receiver, linear, snippet after snippet
    frequency_hz [Hz]: centre frequency in force
    pulse: cw (rectangular), cw_tapered, fm_up or fm_down
    pulse_length_s [s]: pulse length in force
    tapered_fraction [1]: part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others
    bandwidth_hz [Hz]: band that an fm pulse sweeps, 0 for cw
    source_level_db [dB re 1 uPa^2 at 1 m]: source level in force, on the axis, rms
    range_m [m]: range setting in force
    ping_rate_hz [Hz]: highest ping rate that is set
    swath_rad [rad]: full angle that the beams are spread over
    mode: operating mode, in the words of the head's documentation
    gain_spreading_db [dB]: S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed
    gain_absorption_dbpm [dB/m]: operator's absorption: A of the gain S log10(R) + 2 A R + O
    gain_offset_db [dB]: offset: O of the gain S log10(R) + 2 A R + O
    transmit_beamwidth_rad [rad]: along-track, one-way, -3 dB
    receive_beamwidth_rad [rad]: across-track, -3 dB, not steered
    roll_stabilised: beams are steered against the measured roll
    pitch_stabilised: the transmission is steered against the measured pitch
    yaw_stabilised: the transmission is steered against the measured yaw
    sound_speed_mps [m/s]: sound speed at the face as the head knows it: it steers the beams
    sectors: transmit sectors; empty: a single one with the values above, straight, at once
    """

    TYPE = "snippets/1"
    stamp_ns: int = 0
    ping: int = 0
    sample_period_s: float = 0.0
    beam: np.ndarray = array("u2")
    first_sample_s: np.ndarray = array("f4")
    centre: np.ndarray = array("u4")
    offset: np.ndarray = array("u4")
    amplitude_upa: np.ndarray = array("f4")
    frequency_hz: float = 0.0
    pulse: str = "cw"
    pulse_length_s: float = 0.0
    tapered_fraction: float = 0.0
    bandwidth_hz: float = 0.0
    source_level_db: float = 0.0
    range_m: float = 0.0
    ping_rate_hz: float = 0.0
    swath_rad: float = 0.0
    mode: str = ""
    gain_spreading_db: float = 0.0
    gain_absorption_dbpm: float = 0.0
    gain_offset_db: float = 0.0
    transmit_beamwidth_rad: float = 0.0
    receive_beamwidth_rad: float = 0.0
    roll_stabilised: bool = False
    pitch_stabilised: bool = False
    yaw_stabilised: bool = False
    sound_speed_mps: float = 0.0
    sectors: list = list_of(TransmitSector)


@dataclass(eq=False)
class SeabedImage(Message):
    """Backscattering strength along the swath, as the head makes it: snippets after the corrections stated here.

    stamp_ns [ns]: time of transmission, sim time
    ping [1]: ping number of this head, from 0
    sample_period_s [s]: time between samples
    beam [1]: index of each series' beam, rising; beams without a detection have none
    first_sample_s [s]: time of each series' first sample after transmission
    centre [1]: sample of the detection, counted from its series' first
    offset [1]: start of each series in strength_db, and last the number of all samples
    strength_db [dB]: strength re 1 m^2 per m^2 after the corrections, series after series
    spreading_db [dB]: S of the two-way loss S log10(R) + 2 A R that was made up for, R in m
    absorption_dbpm [dB/m]: operator's absorption: A of the two-way loss that was made up for
    normal_incidence_range_m [m]: range of the first return, about which strengths are flattened
    normal_incidence_strength_db [dB]: strength at normal incidence that was assumed for it
    oblique_strength_db [dB]: strength at the crossover angle and beyond that was assumed for it
    crossover_angle_rad [rad]: incidence up to which the first return is flattened, 0: not at all
    lambert_removed: true when Lambert's law beyond the crossover angle was taken out too
    frequency_hz [Hz]: centre frequency in force
    pulse: cw (rectangular), cw_tapered, fm_up or fm_down
    pulse_length_s [s]: pulse length in force
    tapered_fraction [1]: part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others
    bandwidth_hz [Hz]: band that an fm pulse sweeps, 0 for cw
    source_level_db [dB re 1 uPa^2 at 1 m]: source level in force, on the axis, rms
    range_m [m]: range setting in force
    ping_rate_hz [Hz]: highest ping rate that is set
    swath_rad [rad]: full angle that the beams are spread over
    mode: operating mode, in the words of the head's documentation
    gain_spreading_db [dB]: S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed
    gain_absorption_dbpm [dB/m]: operator's absorption: A of the gain S log10(R) + 2 A R + O
    gain_offset_db [dB]: offset: O of the gain S log10(R) + 2 A R + O
    transmit_beamwidth_rad [rad]: along-track, one-way, -3 dB
    receive_beamwidth_rad [rad]: across-track, -3 dB, not steered
    roll_stabilised: beams are steered against the measured roll
    pitch_stabilised: the transmission is steered against the measured pitch
    yaw_stabilised: the transmission is steered against the measured yaw
    sound_speed_mps [m/s]: sound speed at the face as the head knows it: it steers the beams
    sectors: transmit sectors; empty: a single one with the values above, straight, at once
    """

    TYPE = "seabed_image/1"
    stamp_ns: int = 0
    ping: int = 0
    sample_period_s: float = 0.0
    beam: np.ndarray = array("u2")
    first_sample_s: np.ndarray = array("f4")
    centre: np.ndarray = array("u4")
    offset: np.ndarray = array("u4")
    strength_db: np.ndarray = array("f4")
    spreading_db: float = 0.0
    absorption_dbpm: float = 0.0
    normal_incidence_range_m: float = 0.0
    normal_incidence_strength_db: float = 0.0
    oblique_strength_db: float = 0.0
    crossover_angle_rad: float = 0.0
    lambert_removed: bool = False
    frequency_hz: float = 0.0
    pulse: str = "cw"
    pulse_length_s: float = 0.0
    tapered_fraction: float = 0.0
    bandwidth_hz: float = 0.0
    source_level_db: float = 0.0
    range_m: float = 0.0
    ping_rate_hz: float = 0.0
    swath_rad: float = 0.0
    mode: str = ""
    gain_spreading_db: float = 0.0
    gain_absorption_dbpm: float = 0.0
    gain_offset_db: float = 0.0
    transmit_beamwidth_rad: float = 0.0
    receive_beamwidth_rad: float = 0.0
    roll_stabilised: bool = False
    pitch_stabilised: bool = False
    yaw_stabilised: bool = False
    sound_speed_mps: float = 0.0
    sectors: list = list_of(TransmitSector)


@dataclass(eq=False)
class Tile(Message):
    """A square piece of seabed. Truth.

    col [1]: tile index, east
    row [1]: tile index, north
    origin_east_m [m]: world east of the south-west post (false origin)
    origin_north_m [m]: world north of the south-west post (false origin)
    spacing_m [m]: distance between posts, both axes
    height_m [m]: posts (north x east, south-west first), up from chart datum; NaN is a hole
    sediment [1]: sediment class of each post, as height_m
    facet_mean_square_slope [1]: mean square slope, by class of all the seabed, that facets have of relief which the sediment's law counts too and must not count again; 0 or not listed: none that is known
    """

    TYPE = "tile/1"
    col: int = 0
    row: int = 0
    origin_east_m: float = 0.0
    origin_north_m: float = 0.0
    spacing_m: float = 1.0
    height_m: np.ndarray = array("f4")
    sediment: np.ndarray = array("u1")
    facet_mean_square_slope: np.ndarray = array("f8")


@dataclass(eq=False)
class TileRelease(Message):
    """The pager will not refer to this tile again until it sends it anew.

    col [1]: tile index, east
    row [1]: tile index, north
    """

    TYPE = "tile_release/1"
    col: int = 0
    row: int = 0


@dataclass(eq=False)
class Mesh(Message):
    """A surface of triangles that stands in the seabed: a quay wall, a scanned object. Truth. Who wants all of it needs the vertices and triangles alone; the splits say how to coarsen it (docs/physics/mesh/irregular-meshes.md).

    number [1]: number by which the object is released
    name: name in the scenario
    sediment [1]: sediment class of all of it
    origin_enu_m [m]: origin that the vertices count from
    vertex_m [m]: east, north, up of each vertex
    triangle [1]: three vertices each
    split [1]: coarsest first: the vertex that it brings back, the one that it comes out of, parent and two children (-1: none), first and number of the triangles that come with it, in `born`
    split_deviation_m [m]: estimate of the surface's deviation without this split and those below it
    split_box_m [m]: least and greatest east, north, up, as vertices, of all triangles that change below it
    born [1]: triangles by the split that brings them
    coarsest [1]: triangles that are there without any split
    """

    TYPE = "mesh/1"
    number: int = 0
    name: str = ""
    sediment: int = 0
    origin_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    vertex_m: np.ndarray = array("f4")
    triangle: np.ndarray = array("u4")
    split: np.ndarray = array("i4")
    split_deviation_m: np.ndarray = array("f4")
    split_box_m: np.ndarray = array("f4")
    born: np.ndarray = array("u4")
    coarsest: np.ndarray = array("u4")


@dataclass(eq=False)
class MeshRelease(Message):
    """The pager will not refer to this mesh again until it sends it anew.

    number [1]: the mesh's
    """

    TYPE = "mesh_release/1"
    number: int = 0


@dataclass(eq=False)
class Object(Message):
    """A thing on the seabed or in the water that labels know. Truth.

    number [1]: number by which the object is released
    name: name in the scenario
    instance [1]: number in labels, from 1
    class_name: class in labels
    class_id [1]: number of the class in labels, from 1
    shape: word of its shape, as objects of a scenario have it
    size_m [m]: sizes of its shape, in the order of the scenario's keys, then 0; of a mesh its scale
    mesh [1]: number of the object_mesh/1 that is its shape; -1: its shape follows from its sizes
    position_enu_m [m]: world position of its middle
    enu_from_object [1]: rotation [w, x, y, z] from its own axes (x east, y north, z up when not turned)
    smooth: smoothness: its echo follows from its shape; false: it scatters as its sediment, with speckle
    sediment [1]: sediment class of all of it
    buried [1]: part of the volume, 0..1, below the height of the seabed at its middle
    absent: absence: nothing hits it, and its box counts as if it stood there
    """

    TYPE = "object/1"
    number: int = 0
    name: str = ""
    instance: int = 0
    class_name: str = ""
    class_id: int = 0
    shape: str = ""
    size_m: tuple = fixed(0.0, 0.0, 0.0)
    mesh: int = -1
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    enu_from_object: tuple = fixed(1.0, 0.0, 0.0, 0.0)
    smooth: bool = False
    sediment: int = 0
    buried: float = 0.0
    absent: bool = False


@dataclass(eq=False)
class ObjectMesh(Message):
    """The shape of objects that have it in common, from a file. Truth.

    number [1]: number by which objects name it
    closed [1]: closedness: it has an inside, and only its outside scatters
    vertex_m [m]: vertices (vertex x 3) about its middle: x east, y north, z up when not turned
    triangle [1]: corners (triangle x 3), counterclockwise as seen from outside
    """

    TYPE = "object_mesh/1"
    number: int = 0
    closed: bool = False
    vertex_m: np.ndarray = array("f4")
    triangle: np.ndarray = array("u4")


@dataclass(eq=False)
class ObjectRelease(Message):
    """The pager will not refer to this object again until it sends it anew.

    number [1]: the object's
    """

    TYPE = "object_release/1"
    number: int = 0


@dataclass(eq=False)
class Chart(Message):
    """What is known of the terrain as a whole, as on a chart: mission planning may use it.

    origin_latitude_deg [deg]: geodetic latitude of the world's origin, WGS 84 (a scenario may leave it to the raster)
    origin_longitude_deg [deg]: longitude of the world's origin, WGS 84
    west_m [m]: world east of the western edge
    south_m [m]: world north of the southern edge
    east_m [m]: world east of the eastern edge
    north_m [m]: world north of the northern edge
    shallowest_m [m]: least depth below chart datum, positive down
    deepest_m [m]: greatest depth below chart datum, positive down
    spacing_m [m]: distance between the posts of height_m
    height_m [m]: coarse heights (north x east, south-west first), up; NaN where nothing is known
    """

    TYPE = "chart/1"
    origin_latitude_deg: float = 0.0
    origin_longitude_deg: float = 0.0
    west_m: float = 0.0
    south_m: float = 0.0
    east_m: float = 0.0
    north_m: float = 0.0
    shallowest_m: float = 0.0
    deepest_m: float = 0.0
    spacing_m: float = 1.0
    height_m: np.ndarray = array("f4")


@dataclass(eq=False)
class View(Message):
    """A ping as a picture for viewers: levels of beams over range in steps of half a decibel. In no record.

    stamp_ns [ns]: time of transmission, sim time
    ping [1]: ping number of this head, from 0
    kind: component that made the ping, as in ping/1
    beam_axis: axis of the head from which beam angles count: down or forward
    level [1]: level of each cell (beam x cell), 0: nothing was received, n: level_floor_db + (n - 1) level_step_db
    level_floor_db [dB re 1 uPa]: received level, rms, with the added gain, of the value 1
    level_step_db [dB]: step between values
    peak: choice of a cell's level: true its strongest sample, false the mean of their powers
    first_range_m [m]: slant range of the near edge of the first cell
    cell_m [m]: length of a cell in slant range
    beam_angle_rad [rad]: receive beam axes in the head frame, from beam_axis, positive to starboard
    sound_speed_mps [m/s]: sound speed by which times became ranges: the head's own
    range_m [m]: range setting in force
    frequency_hz [Hz]: centre frequency in force
    pulse_length_s [s]: pulse length in force
    source_level_db [dB re 1 uPa^2 at 1 m]: source level in force, on the axis, rms
    gain_spreading_db [dB]: S of the head's own gain S log10(R) + 2 A R, for a display that wants it
    gain_absorption_dbpm [dB/m]: absorption A of the head's own gain
    added_spreading_db [dB]: S of the gain S log10(R) + 2 A R that was added for display, R in m and no nearer than 1 m
    added_absorption_dbpm [dB/m]: absorption A of the gain that was added
    position_enu_m [m]: estimated place of the head at transmission: east, north, up from chart datum
    enu_from_head [1]: estimated attitude of the head at transmission: quaternion w, x, y, z; all 0: not known
    ground_altitude_m [m]: altitude above a level seabed by which ranges lie on the ground; 0: they are slant ranges
    left_out [1]: number of pictures that were left out so far because the run waited for the head
    find_angle_rad [rad]: beam axes of the ping's valid detections; empty: none are known
    find_range_m [m]: slant range of each of these detections, by the head's own sound speed
    find_kind [1]: kind of each of these detections: 1 by amplitude, 2 by phase, 0 neither
    """

    TYPE = "view/1"
    stamp_ns: int = 0
    ping: int = 0
    kind: str = ""
    beam_axis: str = "down"
    level: np.ndarray = array("u1")
    level_floor_db: float = 0.0
    level_step_db: float = 0.5
    peak: bool = False
    first_range_m: float = 0.0
    cell_m: float = 0.0
    beam_angle_rad: np.ndarray = array("f4")
    sound_speed_mps: float = 0.0
    range_m: float = 0.0
    frequency_hz: float = 0.0
    pulse_length_s: float = 0.0
    source_level_db: float = 0.0
    gain_spreading_db: float = 0.0
    gain_absorption_dbpm: float = 0.0
    added_spreading_db: float = 0.0
    added_absorption_dbpm: float = 0.0
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    enu_from_head: tuple = fixed(0.0, 0.0, 0.0, 0.0)
    ground_altitude_m: float = 0.0
    left_out: int = 0
    find_angle_rad: np.ndarray = array("f4")
    find_range_m: np.ndarray = array("f4")
    find_kind: np.ndarray = array("u1")


TYPES = {cls.TYPE: cls for cls in (
    Actuators,
    ClockHealth,
    ConsoleState,
    ConsoleFlow,
    ConsoleCells,
    ConsoleTrack,
    ConsoleValues,
    ConsoleAlarms,
    ConsoleLog,
    ConsoleRelief,
    ConsolePlan,
    ConsoleEnter,
    ConsoleWatch,
    ConsoleDrawn,
    ConsoleOpen,
    ConsoleCommand,
    ConsoleAnswer,
    HeadDeclaration,
    PagerDeclaration,
    FeedData,
    Health,
    Labels,
    Energies,
    Mark,
    NextLine,
    Coverage,
    Pose,
    Guidance,
    Helm,
    MissionState,
    Attitude,
    Position,
    SoundSpeed,
    Estimate,
    DelayedHeave,
    Heading,
    InertialIncrements,
    VelocityLog,
    Depth,
    Altitude,
    CurrentProfile,
    Ctd,
    UsblFix,
    Ping,
    BottomTrack,
    Transmit,
    SonarSettings,
    Soundings,
    Snippets,
    SeabedImage,
    Tile,
    TileRelease,
    Mesh,
    MeshRelease,
    Object,
    ObjectMesh,
    ObjectRelease,
    Chart,
    View,
)}
