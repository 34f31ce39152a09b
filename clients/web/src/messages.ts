// Message types, generated from messages/*.h by generate_messages.py: edit those, not this.

/** An array of a message: elements in C order. */
export interface Numbers<T> {
  shape: number[];
  data: T;
}

export interface Actuators {
  /** time of the order, sim time (ns) */
  stamp_ns: number;
  /** revolutions of each propeller, ahead positive, in the order of the dynamics file (rev/s) */
  propeller_rps: Numbers<Float64Array>;
  /** angle of each fin, positive as the dynamics file has its lift, in its order (rad) */
  fin_rad: Numbers<Float64Array>;
  /** name of the vehicle that is meant; empty: whichever receives it */
  vehicle: string;
  /** release of the vehicle to the next of those who may steer it (1) */
  hand_back: boolean;
}

export interface Pace {
  /** name of the process in the launch file */
  name: string;
  /** grants given to it (1) */
  grants: number;
  /** wall time inside its events (s) */
  cost_s: number;
  /** grants that it finished last, the run being late (1) */
  late_events: number;
  /** largest lateness charged to it, sim time (s) */
  worst_lateness_s: number;
}

export interface ClockHealth {
  /** sim time that all participants have reached (ns) */
  stamp_ns: number;
  /** running or paused */
  state: string;
  /** wall time since sim time started (s) */
  wall_s: number;
  /** sim seconds per wall second asked for; 0: as fast as possible (1) */
  rate: number;
  /** sim seconds per wall second achieved since the report before (1) */
  rate_factor: number;
  /** time that the run stands behind paced time, sim time (s) */
  lateness_s: number;
  /** number of times that lost time was given up (slip_after_s) (1) */
  slips: number;
  /** sim time given up in all (s) */
  slip_s: number;
  /** participants by rank */
  participants: Pace[];
}

export interface ConsoleTopic {
  /** name of the topic; of a head's pictures HEAD/view */
  name: string;
  /** message type */
  type: string;
  /** process that publishes it */
  publisher: string;
  /** component of the publisher, of a record for heads alone; empty: not known */
  component: string;
}

export interface ConsoleItem {
  /** name by which it is opened */
  id: string;
  /** run or record */
  kind: string;
  /** line that describes it */
  text: string;
}

export interface ConsoleScalar {
  /** name of the number in its message, with dots where it lies deeper */
  field: string;
  /** unit in which it is sent: degrees for angles */
  unit: string;
  /** meaning of the number */
  about: string;
}

export interface ConsoleType {
  /** message type */
  type: string;
  /** numbers of its messages, and what follows from them */
  scalars: ConsoleScalar[];
}

export interface ConsoleState {
  /** kind of source: run, record, or empty where nothing is open */
  kind: string;
  /** name of the run or record */
  name: string;
  /** launch file of a run, as far as it is known */
  launch: string;
  /** waiting, running, paused or ended */
  state: string;
  /** why, in one line */
  message: string;
  /** true where this viewer may pause, resume, set the rate and stop */
  may_control: boolean;
  /** exit code of a run that has ended and was started by this console (1) */
  exit_code: number;
  /** sim seconds per wall second that are asked for; 0: as fast as possible (1) */
  speed: number;
  /** topics that can be watched */
  topics: ConsoleTopic[];
  /** types of these topics that have numbers to be drawn over time */
  types: ConsoleType[];
  /** live runs and records that can be opened */
  items: ConsoleItem[];
  /** launch files of the installation, to be started from a shell */
  launches: string[];
}

export interface ConsoleFlowTopic {
  /** name of the topic */
  topic: string;
  /** number of messages sent to this viewer (1) */
  sent: number;
  /** number of messages that it was not sent: of pictures those that a newer one replaced (1) */
  lost: number;
  /** number of times that its pictures are halved in width for the sake of the link (1) */
  halved: number;
  /** messages sent per second of wall time since the report before (Hz) */
  rate_hz: number;
  /** wall time from the arrival of the newest message at the gateway until the viewer had drawn it (s) */
  age_s: number;
}

export interface ConsoleFlow {
  /** rate of the link as the last pictures found it; 0: not known (B/s) */
  link_bytes_per_s: number;
  /** number of bytes that wait for this viewer (1) */
  waiting_bytes: number;
  /** topics that are watched */
  topics: ConsoleFlowTopic[];
}

export interface ConsoleCells {
  /** number of the grid; with another one all earlier cells are void (1) */
  generation: number;
  /** sim time of the first ping in the grid (ns) */
  since_ns: number;
  /** side of a cell (m) */
  cell_m: number;
  /** column of each cell: its western edge lies at column times cell_m (1) */
  column: Numbers<Int32Array>;
  /** row of each cell: its southern edge lies at row times cell_m (1) */
  row: Numbers<Int32Array>;
  /** number of soundings in each cell (1) */
  count: Numbers<Uint32Array>;
  /** mean depth of each cell, positive down from chart datum (m) */
  mean_depth_m: Numbers<Float32Array>;
  /** least depth of each cell (m) */
  shoalest_depth_m: Numbers<Float32Array>;
  /** standard deviation of each cell's depths; NaN of fewer than two (m) */
  sd_m: Numbers<Float32Array>;
}

export interface ConsoleTrack {
  /** number of the track; with another one all earlier points are void (1) */
  generation: number;
  /** name of the topic that the track comes from */
  source: string;
  /** true for the true pose, false for an estimate */
  truth: boolean;
  /** sim time of the newest position (ns) */
  stamp_ns: number;
  /** newest position: east, north, up from chart datum (m) */
  position_enu_m: number[];
  /** newest heading, clockwise from grid north (rad) */
  heading_rad: number;
  /** index of the first of the new points (1) */
  first: number;
  /** new points (point x 2): east, north; half a metre apart or more (m) */
  point_enu_m: Numbers<Float64Array>;
}

export interface ConsoleSeries {
  /** name of the number: TOPIC.field */
  name: string;
  /** unit of its values; empty: not known */
  unit: string;
  /** index of the first of the new points (1) */
  first: number;
  /** sim time of each point (s) */
  time_s: Numbers<Float64Array>;
  /** value of each point; NaN: a gap. Of more than ten a second, the least and the greatest of every 0.2 s */
  value: Numbers<Float64Array>;
}

export interface ConsoleValues {
  /** number of the run; with another one all earlier points are void (1) */
  generation: number;
  /** numbers with new points */
  series: ConsoleSeries[];
}

export interface ConsoleAlarm {
  /** no_bottom, off_line, late, late_pings, slips, lost, disk, degraded or failed */
  kind: string;
  /** name of the process, topic or folder that it is about */
  source: string;
  /** cause, in one line */
  text: string;
  /** true while its cause lasts; what happens at a moment is never active */
  active: boolean;
  /** number of times that it was raised; one that is higher needs another acknowledgement (1) */
  raised: number;
  /** sim time at which it was raised last (ns) */
  since_ns: number;
}

export interface ConsoleAlarms {
  /** number of the run; acknowledgements of another one are void (1) */
  generation: number;
  /** alarms, at most 64 */
  alarms: ConsoleAlarm[];
}

export interface ConsoleLogLine {
  /** name of the process that wrote it */
  process: string;
  /** error, warning or info, by the words of the line */
  level: string;
  /** line, at most 500 bytes */
  text: string;
}

export interface ConsoleLog {
  /** number of the run; with another one all earlier lines are void (1) */
  generation: number;
  /** index of the first of these lines, of all that were read (1) */
  first: number;
  /** lines */
  lines: ConsoleLogLine[];
}

export interface ConsoleRelief {
  /** map of the world's plane, in the words of PROJ: east and north in metres on WGS 84 */
  projection: string;
  /** world east of the western posts (m) */
  west_m: number;
  /** world north of the southern posts (m) */
  south_m: number;
  /** distance between posts (m) */
  spacing_m: number;
  /** brightness of each post (north x east, south-west first) in light from the north-west, 1 dark to 255 bright; 0: nothing is known (1) */
  shade: Numbers<Uint8Array>;
  /** factor by which slopes are steeper in the shading than they are (1) */
  exaggeration: number;
  /** difference of depth between contours (m) */
  contour_step_m: number;
  /** depth of each piece of a contour, below chart datum (m) */
  contour_depth_m: Numbers<Float32Array>;
  /** straight pieces of contours (piece x 4): east and north of both ends (m) */
  contour_m: Numbers<Float32Array>;
}

export interface ConsoleMark {
  /** description of the mark */
  text: string;
  /** estimated position of the vehicle then: east, north (m) */
  position_enu_m: number[];
}

export interface ConsolePlan {
  /** runlines in the order run (line x 4): east and north of the start, then of the end (m) */
  line_enu_m: Numbers<Float64Array>;
  /** marks, the oldest first */
  marks: ConsoleMark[];
}

export interface ConsoleEnter {
  /** token of the URL to view or to control */
  token: string;
}

export interface ConsoleWatched {
  /** name of the topic */
  topic: string;
  /** most cells of a picture over range, 16 to 1024 (1) */
  cells: number;
  /** choice of a cell's level: true its strongest sample */
  peak: boolean;
  /** S of the gain S log10(R) + 2 A R to add for display, 0 to 60 (dB) */
  spreading_db: number;
  /** absorption A of the gain to add, 0 to 1 (dB/m) */
  absorption_dbpm: number;
}

export interface ConsoleWatch {
  /** true while nobody can see the page: nothing is sent to it */
  hidden: boolean;
  /** topics, at most 64 */
  topics: ConsoleWatched[];
  /** names of numbers (TOPIC.field) of the topic values, at most 32 */
  values: string[];
  /** topics of these whose ranges are to lie on the ground, where the head's altitude is known */
  ground: string[];
}

export interface ConsoleDrawn {
  /** name of the topic */
  topic: string;
  /** seq of the message's envelope (1) */
  seq: number;
}

export interface ConsoleOpen {
  /** id of an item of console_state/1 */
  id: string;
}

export interface ConsoleCommand {
  /** pause, resume, rate or stop */
  command: string;
  /** sim seconds per wall second for the command rate; 0: as fast as possible (1) */
  rate: number;
}

export interface ConsoleAnswer {
  /** type of the message that asked */
  request: string;
  /** cause and what is allowed */
  error: string;
}

export interface SectorDeclaration {
  /** centre frequency (Hz) */
  frequency_hz: number;
  /** start after the ping's time of transmission (s) */
  delay_s: number;
}

export interface SettingDeclaration {
  /** field of sonar_settings/1 */
  setting: string;
  /** least value of a number; equal to the most: it is fixed (unit of that field) */
  least: number;
  /** greatest value of a number (unit of that field) */
  most: number;
  /** true where 0 lets the head choose (1) */
  chosen: boolean;
  /** values of a text; empty for a number */
  words: string[];
}

export interface ChannelDeclaration {
  /** end of its ports' names; empty: the only channel */
  name: string;
  /** transmissions of a ping */
  sectors: SectorDeclaration[];
  /** limits of what a command may set; what is not listed cannot be set */
  settings: SettingDeclaration[];
}

export interface HeadDeclaration {
  /** kind of head, as in ping/1 */
  kind: string;
  /** class of instruments that the head stands for, such as em2040; empty: none in particular */
  instrument: string;
  /** axis of the head from which beam angles count, positive to starboard: down or forward */
  beam_axis: string;
  /** half-power width of the finest beam (rad) */
  finest_beam_rad: number;
  /** range within which the unfocused receive array is in its near field; 0: not stated (m) */
  near_field_m: number;
  /** distance from the vehicle's origin to which the longest range reaches; 0: it has no range (m) */
  reach_m: number;
  /** true where the range follows the depth in every channel (1) */
  auto_range: boolean;
  /** transducer, as measured: forward, starboard, down (m) */
  position_body_m: number[];
  /** rotation, as measured: quaternion w, x, y, z (1) */
  body_from_head: number[];
  /** channels that ping together */
  channels: ChannelDeclaration[];
}

export interface PagerDeclaration {
  /** distance between posts (m) */
  post_spacing_m: number;
  /** least depth below chart datum, positive down (m) */
  shallowest_m: number;
}

export interface FeedPiece {
  /** name of the source that sent them */
  source: string;
  /** time of their arrival, sim time (ns) */
  arrival_ns: number;
  /** number of bytes (1) */
  byte_count: number;
  /** true for the first of a connection */
  begins: boolean;
  /** true for a datagram, which nothing continues */
  whole: boolean;
}

export interface FeedData {
  /** time of the event, sim time (ns) */
  stamp_ns: number;
  /** pieces in the order in which they were taken */
  pieces: FeedPiece[];
  /** bytes of all pieces, one after the other (1) */
  bytes: Numbers<Uint8Array>;
}

export interface Counter {
  /** name of what is counted */
  name: string;
  /** number of times since the start (1) */
  count: number;
}

export interface Health {
  /** time of the report, sim time (ns) */
  stamp_ns: number;
  /** ok, degraded or failed */
  state: string;
  /** why, in one line */
  message: string;
  /** counts of what happened */
  counters: Counter[];
}

export interface LabelledObject {
  /** number in the world, from 1, of all pings and heads (1) */
  instance: number;
  /** name in the scenario */
  name: string;
  /** class */
  class_name: string;
  /** number of the class, from 1 (1) */
  class_id: number;
  /** part of the silhouette's solid angle, 0..1, that is within the image (1) */
  inside: number;
  /** part of that, 0..1, that nothing hides (1) */
  visible: number;
  /** rest of it, which the seabed or another object hides (1) */
  occluded: number;
  /** part of the volume that lies below the seabed (1) */
  buried: number;
  /** middle of the visible surface, world position (m) */
  hit_enu_m: number[];
  /** distance from the head at transmission to that middle (m) */
  range_m: number;
  /** grazing angle, mean over the visible surface (rad) */
  grazing_rad: number;
  /** bearing of the head from the object, clockwise from its own north (rad) */
  aspect_rad: number;
  /** sediment class by whose law it scatters (1) */
  sediment: number;
  /** smoothness: its echo follows from its shape */
  smooth: boolean;
  /** box round its mask: first beam, first sample, beam and sample after the last; all 0: no mask (1) */
  box: number[];
  /** box round its shadow, of the same form; all 0: no shadow (1) */
  shadow_box: number[];
}

export interface Labels {
  /** time of transmission, sim time, as of the ping (ns) */
  stamp_ns: number;
  /** ping number of this head, as of the ping (1) */
  ping: number;
  /** rows of the image (1) */
  beams: number;
  /** columns of the image (1) */
  samples: number;
  /** objects within the range and the head's view, by instance */
  objects: LabelledObject[];
  /** runs (run x 4) of the objects' own masks, which may overlap: place in objects, beam, first sample, sample after the last (1) */
  mask_run: Numbers<Int32Array>;
  /** runs (run x 4) of one mask of all: where several overlap, the one that sends most (1) */
  layer_run: Numbers<Int32Array>;
  /** runs (run x 4) of shadows: place in objects of what casts it, -1: the seabed itself; beam, first sample, sample after the last (1) */
  shadow_run: Numbers<Int32Array>;
  /** depth of the shadow at each sample of the runs, one after the other: what the seabed would send there without objects over what it sends, at most 60; 0 of the seabed's own (dB) */
  shadow_db: Numbers<Uint8Array>;
}

export interface EnergySource {
  /** kind of source: noise, volume (the water), interference (other heads and sectors), surface, seabed or object */
  kind: string;
  /** way of the sound: direct, surface (out or back by way of it) or bottom (by way of both) */
  path: string;
  /** number of the object in the world, from 1; 0: none (1) */
  instance: number;
  /** name of the object in the scenario */
  name: string;
  /** class of the object */
  class_name: string;
  /** number of the object's class, from 1; 0: no object (1) */
  class_id: number;
  /** sediment class, of the seabed or of what the object scatters as (1) */
  sediment: number;
}

export interface Energies {
  /** time of transmission, sim time, as of the ping (ns) */
  stamp_ns: number;
  /** ping number of this head, as of the ping (1) */
  ping: number;
  /** rows of the image (1) */
  beams: number;
  /** columns of the image (1) */
  samples: number;
  /** time of the first sample after transmission, as of the ping (s) */
  first_sample_s: number;
  /** time between samples (s) */
  sample_period_s: number;
  /** sources of sound; the first is noise, and of equals the earlier counts as the stronger */
  sources: EnergySource[];
  /** runs (run x 4) of what sources send: place in sources, beam, first sample, sample after the last. What is less than a millionth of a sample is left out (1) */
  run: Numbers<Int32Array>;
  /** mean square at each sample of the runs, one after the other (uPa^2) */
  energy_upa2: Numbers<Float32Array>;
}

export interface Mark {
  /** time of the mark, sim time (ns) */
  stamp_ns: number;
  /** description of the mark */
  text: string;
  /** estimated position of the vehicle then: east, north, up (m) */
  position_enu_m: number[];
}

export interface NextLine {
  /** time of the decision, sim time (ns) */
  stamp_ns: number;
  /** index of the line in the survey, the first is 0 and known beforehand (1) */
  number: number;
  /** true when nothing is left to run; the line means nothing then */
  done: boolean;
  /** start of the line: east, north (m) */
  start_enu_m: number[];
  /** end of the line: east, north (m) */
  end_enu_m: number[];
}

export interface Coverage {
  /** time of validity, sim time (ns) */
  stamp_ns: number;
  /** number of lines run (1) */
  lines: number;
  /** the rectangle's rear port corner: east, north (m) */
  corner_enu_m: number[];
  /** forward along the rectangle, clockwise from grid north (rad) */
  heading_grid_rad: number;
  /** side of a cell (m) */
  cell_m: number;
  /** accepted soundings that a covered cell has at least (1) */
  needed: number;
  /** share of the cells that are covered (1) */
  covered: number;
  /** redundancy: how often a covered cell was covered, by lines, on average (1) */
  overlapped: number;
  /** length of all lines run, without turns (m) */
  track_m: number;
  /** time from the first sounding to the last (s) */
  elapsed_s: number;
  /** accepted soundings of each cell (starboard x forward), as far as it can count (1) */
  soundings: Numbers<Uint16Array>;
  /** mean height of each cell's accepted soundings, up from chart datum; NaN: none (m) */
  height_m: Numbers<Float32Array>;
}

export interface Pose {
  /** time of validity, sim time (ns) */
  stamp_ns: number;
  /** body origin in the world frame: east, north, up from chart datum (m) */
  position_enu_m: number[];
  /** attitude quaternion w, x, y, z (w >= 0) from body FRD to world ENU (1) */
  enu_from_body: number[];
  /** velocity of the body origin in the world frame (m/s) */
  velocity_enu_mps: number[];
  /** angular rate in the body frame, FRD (rad/s) */
  rate_body_radps: number[];
  /** acceleration of the body origin in the world frame; less gravity, turned to the body, it is the specific force (m/s^2) */
  acceleration_enu_mps2: number[];
  /** rate of the angular rate, body frame (rad/s^2) */
  angular_acceleration_body_radps2: number[];
}

export interface Guidance {
  /** time of the command, sim time (ns) */
  stamp_ns: number;
  /** heading to steer, clockwise from grid north (rad) */
  heading_grid_rad: number;
  /** speed through the water to reach, forward (m/s) */
  speed_mps: number;
  /** depth of the body origin below the water level to hold; NaN: as before (m) */
  depth_m: number;
  /** name of the vehicle that is meant; empty: whichever receives it */
  vehicle: string;
  /** release of the vehicle to the next of those who may steer it (1) */
  hand_back: boolean;
}

export interface Helm {
  /** time of the state, sim time (ns) */
  stamp_ns: number;
  /** name of the pilot whose commands are obeyed; empty: nobody's */
  steered_by: string;
  /** names of those who may steer it, the first before the others */
  pilots: string[];
  /** reason of the last change: commands, silent, hand_back; empty: none yet */
  why: string;
  /** number of commands refused so far, of all pilots (1) */
  refused: number;
}

export interface MissionState {
  /** time of the state, sim time (ns) */
  stamp_ns: number;
  /** run_in, on_line, run_out or turn; pass, keep or orbit; await_line; stand_by; abort or done */
  state: string;
  /** index of the runline being run, -1 before the first (1) */
  line: number;
  /** number of runlines in the mission (1) */
  line_count: number;
  /** name of the runline being run; empty: it has none */
  line_name: string;
  /** estimated distance right of the runline, positive to starboard (m) */
  cross_track_m: number;
  /** distance to the end of the runline (m) */
  distance_to_go_m: number;
}

export interface Attitude {
  /** time of measurement, sim time (ns) */
  stamp_ns: number;
  /** roll, positive starboard down (rad) */
  roll_rad: number;
  /** pitch, positive bow up (rad) */
  pitch_rad: number;
  /** heading, clockwise from grid north (rad) */
  heading_grid_rad: number;
  /** vertical displacement from the mean level, positive up (m) */
  heave_m: number;
}

export interface Position {
  /** time of measurement, sim time (ns) */
  stamp_ns: number;
  /** measured body origin in the world frame: east, north, up (m) */
  position_enu_m: number[];
  /** geodetic latitude of the position, WGS 84, positive north (deg) */
  latitude_deg: number;
  /** longitude of the position, WGS 84, positive east (deg) */
  longitude_deg: number;
  /** stated standard deviation, each horizontal axis (m) */
  sigma_horizontal_m: number;
  /** stated standard deviation, up (m) */
  sigma_vertical_m: number;
  /** quality as in NMEA's GGA: 1 single, 2 differential, 4 RTK fixed, 5 RTK float; 0 not given (1) */
  quality: number;
  /** horizontal dilution of precision; 0 not given (1) */
  hdop: number;
  /** height of the body origin, as in NMEA's GGA (m) */
  height_above_geoid_m: number;
  /** undulation of the geoid at the position, WGS 84, as in NMEA's GGA (m) */
  geoid_above_ellipsoid_m: number;
}

export interface SoundSpeed {
  /** time of measurement, sim time (ns) */
  stamp_ns: number;
  /** measured speed of sound in the water at the probe (m/s) */
  sound_speed_mps: number;
}

export interface Estimate {
  /** time of validity, sim time (ns) */
  stamp_ns: number;
  /** estimated body origin in the world frame: east, north, up (m) */
  position_enu_m: number[];
  /** estimated attitude quaternion w, x, y, z (w >= 0), body FRD to ENU (1) */
  enu_from_body: number[];
  /** estimated velocity of the body origin (m/s) */
  velocity_enu_mps: number[];
  /** covariance of the position's error, row by row; all zero: not given (m2) */
  position_covariance_enu_m2: number[];
  /** covariance of the velocity, row by row: east, north, up (m2/s2) */
  velocity_covariance_enu_m2ps2: number[];
  /** covariance of the small rotation about east, north, up from estimate to truth, row by row (rad2) */
  rotation_covariance_enu_rad2: number[];
}

export interface DelayedHeave {
  /** time of the heave, long before the message (ns) */
  stamp_ns: number;
  /** vertical displacement from the mean level, positive up (m) */
  heave_m: number;
}

export interface Heading {
  /** time of measurement, by the instrument's clock (ns) */
  stamp_ns: number;
  /** heading, clockwise from true north (rad) */
  heading_true_rad: number;
}

export interface InertialIncrements {
  /** end of the interval, sim time (ns) */
  stamp_ns: number;
  /** interval that is integrated over (s) */
  interval_s: number;
  /** turn rate against inertial space, integrated, along the unit's axes (rad) */
  angle_rad: number[];
  /** specific force, integrated, along the unit's axes (m/s) */
  velocity_mps: number[];
}

export interface VelocityLog {
  /** time of measurement, by the instrument's clock (ns) */
  stamp_ns: number;
  /** true when velocity is known over ground; else it is zero */
  bottom_lock: boolean;
  /** velocity of the transducer over ground, turned to the body's axes as mounting was measured (m/s) */
  velocity_body_mps: number[];
  /** stated standard deviation of each (m/s) */
  sigma_body_mps: number[];
  /** along each beam to the bottom; 0: no lock (m) */
  range_m: number[];
  /** altitude of the transducer above the bottom; 0: no beam has lock (m) */
  altitude_m: number;
  /** difference in which four beams disagree (m/s) */
  error_velocity_mps: number;
  /** true when velocity is known through the water; else it is zero */
  water_lock: boolean;
  /** velocity of the transducer through the water that is tracked, along the body's axes as mounting was measured (m/s) */
  water_velocity_body_mps: number[];
}

export interface Depth {
  /** time of measurement, by the instrument's clock (ns) */
  stamp_ns: number;
  /** depth of the sensor below the water level (m) */
  depth_m: number;
}

export interface Altitude {
  /** time of measurement, by the instrument's clock (ns) */
  stamp_ns: number;
  /** true when anything answered */
  valid: boolean;
  /** along the beam to the bottom; 0: no answer (m) */
  range_m: number;
}

export interface CurrentProfile {
  /** time of measurement, by the instrument's clock (ns) */
  stamp_ns: number;
  /** bins: distance of each bin's middle along the instrument's axis, rising (m) */
  below_transducer_m: Numbers<Float64Array>;
  /** bins x 3: of the water less the transducer's, along the body's axes as mounting was measured (m/s) */
  velocity_body_mps: Numbers<Float64Array>;
  /** bins: stated standard deviation of each horizontal component (m/s) */
  sigma_mps: Numbers<Float64Array>;
}

export interface Ctd {
  /** time of measurement, by the instrument's clock (ns) */
  stamp_ns: number;
  /** depth of the probe below the water level (m) */
  depth_m: number;
  /** temperature of the water (degC) */
  temperature_degc: number;
  /** practical salinity of the water (psu) */
  salinity_psu: number;
  /** computed from the three before (m/s) */
  sound_speed_mps: number;
}

export interface UsblFix {
  /** time that the place belongs to, by the instrument's clock (ns) */
  stamp_ns: number;
  /** true when the transponder replied; else the rest is zero */
  valid: boolean;
  /** range from array to transponder, by the sound speed that the system uses (m) */
  range_m: number;
  /** transponder less array, along the carrier's body axes as mounting was measured (m) */
  place_body_m: number[];
  /** transponder in the world frame, by the carrier's own estimate (m) */
  position_enu_m: number[];
  /** stated standard deviation of each, of the array's measurement alone (m) */
  sigma_enu_m: number[];
}

export interface TransmitSector {
  /** centre frequency (Hz) */
  frequency_hz: number;
  /** pulse shape of the ping */
  pulse: string;
  /** pulse length (s) */
  pulse_length_s: number;
  /** band that an fm pulse sweeps, 0 for cw (Hz) */
  bandwidth_hz: number;
  /** source level on the axis, rms (dB re 1 uPa^2 at 1 m) */
  source_level_db: number;
  /** steering from the head's athwartships plane, positive forward (rad) */
  tilt_rad: number;
  /** start after the ping's time of transmission (s) */
  delay_s: number;
  /** range of the transmit focus, 0: not focused (m) */
  focus_range_m: number;
}

export interface AppliedSettings {
  /** centre frequency in force (Hz) */
  frequency_hz: number;
  /** cw (rectangular), cw_tapered, fm_up or fm_down */
  pulse: string;
  /** pulse length in force (s) */
  pulse_length_s: number;
  /** part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others (1) */
  tapered_fraction: number;
  /** band that an fm pulse sweeps, 0 for cw (Hz) */
  bandwidth_hz: number;
  /** source level in force, on the axis, rms (dB re 1 uPa^2 at 1 m) */
  source_level_db: number;
  /** range setting in force (m) */
  range_m: number;
  /** highest ping rate that is set (Hz) */
  ping_rate_hz: number;
  /** full angle that the beams are spread over (rad) */
  swath_rad: number;
  /** operating mode, in the words of the head's documentation */
  mode: string;
  /** S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed (dB) */
  gain_spreading_db: number;
  /** operator's absorption: A of the gain S log10(R) + 2 A R + O (dB/m) */
  gain_absorption_dbpm: number;
  /** offset: O of the gain S log10(R) + 2 A R + O (dB) */
  gain_offset_db: number;
  /** along-track, one-way, -3 dB (rad) */
  transmit_beamwidth_rad: number;
  /** across-track, -3 dB, not steered (rad) */
  receive_beamwidth_rad: number;
  /** beams are steered against the measured roll */
  roll_stabilised: boolean;
  /** the transmission is steered against the measured pitch */
  pitch_stabilised: boolean;
  /** the transmission is steered against the measured yaw */
  yaw_stabilised: boolean;
  /** sound speed at the face as the head knows it: it steers the beams (m/s) */
  sound_speed_mps: number;
  /** transmit sectors; empty: a single one with the values above, straight, at once */
  sectors: TransmitSector[];
}

export interface HeadTrack {
  /** times after transmission of the poses; the first is 0: the pose at transmission (s) */
  pose_time_s: Numbers<Float64Array>;
  /** estimated place of the head (time x 3): east, north, up from chart datum, by the measured mounting (m) */
  pose_position_enu_m: Numbers<Float64Array>;
  /** estimated attitude of the head (time x 4): quaternion w, x, y, z, head FRD to ENU (1) */
  pose_enu_from_head: Numbers<Float64Array>;
}

export interface Ping {
  /** time of transmission, sim time (ns) */
  stamp_ns: number;
  /** ping number of this head, from 0 (1) */
  ping: number;
  /** component that made it, such as multibeam or sidescan; empty: not given */
  kind: string;
  /** time between samples (s) */
  sample_period_s: number;
  /** time of the first sample after transmission (s) */
  first_sample_s: number;
  /** receive beam axes of this ping in the head frame, positive to starboard: from its down axis, of heads that look forward (forward_looking, scanning) from its forward axis (rad) */
  beam_angle_rad: Numbers<Float32Array>;
  /** rms pressure amplitude at the receiver (beam x sample), linear, the gain taken out again (uPa) */
  amplitude_upa: Numbers<Float32Array>;
  /** index of each beam's transmit sector; empty: 0 (1) */
  beam_sector: Numbers<Uint8Array>;
  /** digitised amplitude (beam x sample) instead of amplitude_upa, linear, the gain still in it (1) */
  amplitude_count: Numbers<Uint16Array>;
  /** amplitude at the receiver of one count where the gain is 0 dB (uPa) */
  count_upa: number;
  /** phase (beam x sample) of the starboard half of the receive array over the port half, -pi..pi, about the beam axis; empty: not formed (rad) */
  phase_rad: Numbers<Float32Array>;
  /** centre frequency in force (Hz) */
  frequency_hz: number;
  /** cw (rectangular), cw_tapered, fm_up or fm_down */
  pulse: string;
  /** pulse length in force (s) */
  pulse_length_s: number;
  /** part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others (1) */
  tapered_fraction: number;
  /** band that an fm pulse sweeps, 0 for cw (Hz) */
  bandwidth_hz: number;
  /** source level in force, on the axis, rms (dB re 1 uPa^2 at 1 m) */
  source_level_db: number;
  /** range setting in force (m) */
  range_m: number;
  /** highest ping rate that is set (Hz) */
  ping_rate_hz: number;
  /** full angle that the beams are spread over (rad) */
  swath_rad: number;
  /** operating mode, in the words of the head's documentation */
  mode: string;
  /** S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed (dB) */
  gain_spreading_db: number;
  /** operator's absorption: A of the gain S log10(R) + 2 A R + O (dB/m) */
  gain_absorption_dbpm: number;
  /** offset: O of the gain S log10(R) + 2 A R + O (dB) */
  gain_offset_db: number;
  /** along-track, one-way, -3 dB (rad) */
  transmit_beamwidth_rad: number;
  /** across-track, -3 dB, not steered (rad) */
  receive_beamwidth_rad: number;
  /** beams are steered against the measured roll */
  roll_stabilised: boolean;
  /** the transmission is steered against the measured pitch */
  pitch_stabilised: boolean;
  /** the transmission is steered against the measured yaw */
  yaw_stabilised: boolean;
  /** sound speed at the face as the head knows it: it steers the beams (m/s) */
  sound_speed_mps: number;
  /** transmit sectors; empty: a single one with the values above, straight, at once */
  sectors: TransmitSector[];
  /** times after transmission of the poses; the first is 0: the pose at transmission (s) */
  pose_time_s: Numbers<Float64Array>;
  /** estimated place of the head (time x 3): east, north, up from chart datum, by the measured mounting (m) */
  pose_position_enu_m: Numbers<Float64Array>;
  /** estimated attitude of the head (time x 4): quaternion w, x, y, z, head FRD to ENU (1) */
  pose_enu_from_head: Numbers<Float64Array>;
}

export interface BottomTrack {
  /** time of transmission, sim time (ns) */
  stamp_ns: number;
  /** ping number of this head, from 0 (1) */
  ping: number;
  /** true when the bottom was found; the rest means nothing if not */
  valid: boolean;
  /** two-way time of the first bottom return, over all beams and smoothed (s) */
  travel_time_s: number;
  /** altitude: half of the two-way time at the head's sound speed (m) */
  altitude_m: number;
  /** step of the level at the return, over the water column's (dB) */
  quality_db: number;
  /** sound speed that the head used (m/s) */
  sound_speed_mps: number;
  /** first bottom return of each beam (sidescan: port, starboard), NaN: none (s) */
  beam_travel_time_s: Numbers<Float32Array>;
}

export interface Transmit {
  /** time of transmission, sim time; of a sector that is sent later in the ping, its own (ns) */
  stamp_ns: number;
  /** ping number of this head, from 0; equal for all sectors of a ping (1) */
  ping: number;
  /** centre frequency (Hz) */
  frequency_hz: number;
  /** pulse length (s) */
  pulse_length_s: number;
  /** band that an fm pulse sweeps, 0 for cw (Hz) */
  bandwidth_hz: number;
  /** source level on the axis, rms (dB re 1 uPa^2 at 1 m) */
  source_level_db: number;
  /** sim time at which the head intends to transmit next; 0: unknown (ns) */
  next_ns: number;
}

export interface SonarSettings {
  /** time of the command, sim time (ns) */
  stamp_ns: number;
  /** range of reception; 0: the head chooses, where it can (m) */
  range_m: number;
  /** source level on the axis, rms (dB re 1 uPa^2 at 1 m) */
  source_level_db: number;
  /** pulse length; 0: the head chooses, where it can (s) */
  pulse_length_s: number;
  /** S of the gain S log10(R) + 2 A R + O at range R in m (dB) */
  gain_spreading_db: number;
  /** operator's absorption: A of the gain S log10(R) + 2 A R + O (dB/m) */
  gain_absorption_dbpm: number;
  /** offset: O of the gain S log10(R) + 2 A R + O (dB) */
  gain_offset_db: number;
  /** full angle to spread the beams over (rad) */
  swath_rad: number;
  /** highest ping rate (Hz) */
  ping_rate_hz: number;
  /** operating mode, in the words of the head's documentation */
  mode: string;
}

export interface Soundings {
  /** time of transmission, sim time (ns) */
  stamp_ns: number;
  /** ping number of this head, from 0 (1) */
  ping: number;
  /** time between the samples that detection used (s) */
  sample_period_s: number;
  /** index of each entry's beam, rising; empty: entry i is beam i (1) */
  beam: Numbers<Uint16Array>;
  /** number of the detection within its beam, from 0, the first return first; empty: 0 (1) */
  detection: Numbers<Uint8Array>;
  /** index of each entry's transmit sector; empty: 0 (1) */
  sector: Numbers<Uint8Array>;
  /** receive beam axes in the head frame, positive to starboard (rad) */
  beam_angle_rad: Numbers<Float32Array>;
  /** two-way travel time of the detection (s) */
  travel_time_s: Numbers<Float32Array>;
  /** level of the detection re 1 uPa, uncorrected (dB) */
  backscatter_db: Numbers<Float32Array>;
  /** backscattering strength re 1 m^2 per m^2 that the head makes of the level: by its settings, on a flat seabed; empty: not computed (dB) */
  backscatter_strength_db: Numbers<Float32Array>;
  /** signal to noise ratio of the detection (dB) */
  quality_db: Numbers<Float32Array>;
  /** predicted standard deviation of the range, sonar only; empty: not predicted (m) */
  range_sd_m: Numbers<Float32Array>;
  /** predicted standard deviation of the angle, sonar only; empty: not predicted (rad) */
  angle_sd_rad: Numbers<Float32Array>;
  /** length of the window that the detection used; empty: not given (s) */
  window_s: Numbers<Float32Array>;
  /** 1 by amplitude, 2 by phase (of a blend, the one that weighs more), 0 neither; empty: 1 (1) */
  kind: Numbers<Uint8Array>;
  /** why an entry is not valid, added up: 1 weak, 2 cut off by the range, 4 out of the gate, 8 uncertain, 16 side lobe; empty: not given (1) */
  flags: Numbers<Uint8Array>;
  /** 1 where the beam has a sounding; where 0, position_enu_m is NaN, and so is what was not measured (1) */
  valid: Numbers<Uint8Array>;
  /** sounding (beam x 3): east, north, up from chart datum, by estimate and measured mounting (m) */
  position_enu_m: Numbers<Float64Array>;
  /** predicted total vertical uncertainty of position_enu_m: 95 % of the errors are within; empty: not given (m) */
  tvu_m: Numbers<Float32Array>;
  /** stated 95 % of the horizontal error, as a radius; empty: not given (m) */
  thu_m: Numbers<Float32Array>;
  /** centre frequency in force (Hz) */
  frequency_hz: number;
  /** cw (rectangular), cw_tapered, fm_up or fm_down */
  pulse: string;
  /** pulse length in force (s) */
  pulse_length_s: number;
  /** part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others (1) */
  tapered_fraction: number;
  /** band that an fm pulse sweeps, 0 for cw (Hz) */
  bandwidth_hz: number;
  /** source level in force, on the axis, rms (dB re 1 uPa^2 at 1 m) */
  source_level_db: number;
  /** range setting in force (m) */
  range_m: number;
  /** highest ping rate that is set (Hz) */
  ping_rate_hz: number;
  /** full angle that the beams are spread over (rad) */
  swath_rad: number;
  /** operating mode, in the words of the head's documentation */
  mode: string;
  /** S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed (dB) */
  gain_spreading_db: number;
  /** operator's absorption: A of the gain S log10(R) + 2 A R + O (dB/m) */
  gain_absorption_dbpm: number;
  /** offset: O of the gain S log10(R) + 2 A R + O (dB) */
  gain_offset_db: number;
  /** along-track, one-way, -3 dB (rad) */
  transmit_beamwidth_rad: number;
  /** across-track, -3 dB, not steered (rad) */
  receive_beamwidth_rad: number;
  /** beams are steered against the measured roll */
  roll_stabilised: boolean;
  /** the transmission is steered against the measured pitch */
  pitch_stabilised: boolean;
  /** the transmission is steered against the measured yaw */
  yaw_stabilised: boolean;
  /** sound speed at the face as the head knows it: it steers the beams (m/s) */
  sound_speed_mps: number;
  /** transmit sectors; empty: a single one with the values above, straight, at once */
  sectors: TransmitSector[];
  /** times after transmission of the poses; the first is 0: the pose at transmission (s) */
  pose_time_s: Numbers<Float64Array>;
  /** estimated place of the head (time x 3): east, north, up from chart datum, by the measured mounting (m) */
  pose_position_enu_m: Numbers<Float64Array>;
  /** estimated attitude of the head (time x 4): quaternion w, x, y, z, head FRD to ENU (1) */
  pose_enu_from_head: Numbers<Float64Array>;
}

export interface Snippets {
  /** time of transmission, sim time (ns) */
  stamp_ns: number;
  /** ping number of this head, from 0 (1) */
  ping: number;
  /** time between samples (s) */
  sample_period_s: number;
  /** index of each snippet's beam, rising; beams without a detection have none (1) */
  beam: Numbers<Uint16Array>;
  /** time of each snippet's first sample after transmission (s) */
  first_sample_s: Numbers<Float32Array>;
  /** sample of the detection, counted from its snippet's first (1) */
  centre: Numbers<Uint32Array>;
  /** start of each snippet in amplitude_upa, and last the number of all samples (1) */
  offset: Numbers<Uint32Array>;
  /** rms pressure amplitudes at the receiver, linear, snippet after snippet (uPa) */
  amplitude_upa: Numbers<Float32Array>;
  /** centre frequency in force (Hz) */
  frequency_hz: number;
  /** cw (rectangular), cw_tapered, fm_up or fm_down */
  pulse: string;
  /** pulse length in force (s) */
  pulse_length_s: number;
  /** part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others (1) */
  tapered_fraction: number;
  /** band that an fm pulse sweeps, 0 for cw (Hz) */
  bandwidth_hz: number;
  /** source level in force, on the axis, rms (dB re 1 uPa^2 at 1 m) */
  source_level_db: number;
  /** range setting in force (m) */
  range_m: number;
  /** highest ping rate that is set (Hz) */
  ping_rate_hz: number;
  /** full angle that the beams are spread over (rad) */
  swath_rad: number;
  /** operating mode, in the words of the head's documentation */
  mode: string;
  /** S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed (dB) */
  gain_spreading_db: number;
  /** operator's absorption: A of the gain S log10(R) + 2 A R + O (dB/m) */
  gain_absorption_dbpm: number;
  /** offset: O of the gain S log10(R) + 2 A R + O (dB) */
  gain_offset_db: number;
  /** along-track, one-way, -3 dB (rad) */
  transmit_beamwidth_rad: number;
  /** across-track, -3 dB, not steered (rad) */
  receive_beamwidth_rad: number;
  /** beams are steered against the measured roll */
  roll_stabilised: boolean;
  /** the transmission is steered against the measured pitch */
  pitch_stabilised: boolean;
  /** the transmission is steered against the measured yaw */
  yaw_stabilised: boolean;
  /** sound speed at the face as the head knows it: it steers the beams (m/s) */
  sound_speed_mps: number;
  /** transmit sectors; empty: a single one with the values above, straight, at once */
  sectors: TransmitSector[];
}

export interface SeabedImage {
  /** time of transmission, sim time (ns) */
  stamp_ns: number;
  /** ping number of this head, from 0 (1) */
  ping: number;
  /** time between samples (s) */
  sample_period_s: number;
  /** index of each series' beam, rising; beams without a detection have none (1) */
  beam: Numbers<Uint16Array>;
  /** time of each series' first sample after transmission (s) */
  first_sample_s: Numbers<Float32Array>;
  /** sample of the detection, counted from its series' first (1) */
  centre: Numbers<Uint32Array>;
  /** start of each series in strength_db, and last the number of all samples (1) */
  offset: Numbers<Uint32Array>;
  /** strength re 1 m^2 per m^2 after the corrections, series after series (dB) */
  strength_db: Numbers<Float32Array>;
  /** S of the two-way loss S log10(R) + 2 A R that was made up for, R in m (dB) */
  spreading_db: number;
  /** operator's absorption: A of the two-way loss that was made up for (dB/m) */
  absorption_dbpm: number;
  /** range of the first return, about which strengths are flattened (m) */
  normal_incidence_range_m: number;
  /** strength at normal incidence that was assumed for it (dB) */
  normal_incidence_strength_db: number;
  /** strength at the crossover angle and beyond that was assumed for it (dB) */
  oblique_strength_db: number;
  /** incidence up to which the first return is flattened, 0: not at all (rad) */
  crossover_angle_rad: number;
  /** true when Lambert's law beyond the crossover angle was taken out too */
  lambert_removed: boolean;
  /** centre frequency in force (Hz) */
  frequency_hz: number;
  /** cw (rectangular), cw_tapered, fm_up or fm_down */
  pulse: string;
  /** pulse length in force (s) */
  pulse_length_s: number;
  /** part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others (1) */
  tapered_fraction: number;
  /** band that an fm pulse sweeps, 0 for cw (Hz) */
  bandwidth_hz: number;
  /** source level in force, on the axis, rms (dB re 1 uPa^2 at 1 m) */
  source_level_db: number;
  /** range setting in force (m) */
  range_m: number;
  /** highest ping rate that is set (Hz) */
  ping_rate_hz: number;
  /** full angle that the beams are spread over (rad) */
  swath_rad: number;
  /** operating mode, in the words of the head's documentation */
  mode: string;
  /** S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed (dB) */
  gain_spreading_db: number;
  /** operator's absorption: A of the gain S log10(R) + 2 A R + O (dB/m) */
  gain_absorption_dbpm: number;
  /** offset: O of the gain S log10(R) + 2 A R + O (dB) */
  gain_offset_db: number;
  /** along-track, one-way, -3 dB (rad) */
  transmit_beamwidth_rad: number;
  /** across-track, -3 dB, not steered (rad) */
  receive_beamwidth_rad: number;
  /** beams are steered against the measured roll */
  roll_stabilised: boolean;
  /** the transmission is steered against the measured pitch */
  pitch_stabilised: boolean;
  /** the transmission is steered against the measured yaw */
  yaw_stabilised: boolean;
  /** sound speed at the face as the head knows it: it steers the beams (m/s) */
  sound_speed_mps: number;
  /** transmit sectors; empty: a single one with the values above, straight, at once */
  sectors: TransmitSector[];
}

export interface Tile {
  /** tile index, east (1) */
  col: number;
  /** tile index, north (1) */
  row: number;
  /** world east of the south-west post (false origin) (m) */
  origin_east_m: number;
  /** world north of the south-west post (false origin) (m) */
  origin_north_m: number;
  /** distance between posts, both axes (m) */
  spacing_m: number;
  /** posts (north x east, south-west first), up from chart datum; NaN is a hole (m) */
  height_m: Numbers<Float32Array>;
  /** sediment class of each post, as height_m (1) */
  sediment: Numbers<Uint8Array>;
  /** mean square slope, by class of all the seabed, that facets have of relief which the sediment's law counts too and must not count again; 0 or not listed: none that is known (1) */
  facet_mean_square_slope: Numbers<Float64Array>;
}

export interface TileRelease {
  /** tile index, east (1) */
  col: number;
  /** tile index, north (1) */
  row: number;
}

export interface Mesh {
  /** number by which the object is released (1) */
  number: number;
  /** name in the scenario */
  name: string;
  /** sediment class of all of it (1) */
  sediment: number;
  /** origin that the vertices count from (m) */
  origin_enu_m: number[];
  /** east, north, up of each vertex (m) */
  vertex_m: Numbers<Float32Array>;
  /** three vertices each (1) */
  triangle: Numbers<Uint32Array>;
  /** coarsest first: the vertex that it brings back, the one that it comes out of, parent and two children (-1: none), first and number of the triangles that come with it, in `born` (1) */
  split: Numbers<Int32Array>;
  /** estimate of the surface's deviation without this split and those below it (m) */
  split_deviation_m: Numbers<Float32Array>;
  /** least and greatest east, north, up, as vertices, of all triangles that change below it (m) */
  split_box_m: Numbers<Float32Array>;
  /** triangles by the split that brings them (1) */
  born: Numbers<Uint32Array>;
  /** triangles that are there without any split (1) */
  coarsest: Numbers<Uint32Array>;
}

export interface MeshRelease {
  /** the mesh's (1) */
  number: number;
}

export interface Object {
  /** number by which the object is released (1) */
  number: number;
  /** name in the scenario */
  name: string;
  /** number in labels, from 1 (1) */
  instance: number;
  /** class in labels */
  class_name: string;
  /** number of the class in labels, from 1 (1) */
  class_id: number;
  /** word of its shape, as objects of a scenario have it */
  shape: string;
  /** sizes of its shape, in the order of the scenario's keys, then 0; of a mesh its scale (m) */
  size_m: number[];
  /** number of the object_mesh/1 that is its shape; -1: its shape follows from its sizes (1) */
  mesh: number;
  /** world position of its middle (m) */
  position_enu_m: number[];
  /** rotation [w, x, y, z] from its own axes (x east, y north, z up when not turned) (1) */
  enu_from_object: number[];
  /** smoothness: its echo follows from its shape; false: it scatters as its sediment, with speckle */
  smooth: boolean;
  /** sediment class of all of it (1) */
  sediment: number;
  /** part of the volume, 0..1, below the height of the seabed at its middle (1) */
  buried: number;
  /** absence: nothing hits it, and its box counts as if it stood there */
  absent: boolean;
}

export interface ObjectMesh {
  /** number by which objects name it (1) */
  number: number;
  /** closedness: it has an inside, and only its outside scatters (1) */
  closed: boolean;
  /** vertices (vertex x 3) about its middle: x east, y north, z up when not turned (m) */
  vertex_m: Numbers<Float32Array>;
  /** corners (triangle x 3), counterclockwise as seen from outside (1) */
  triangle: Numbers<Uint32Array>;
}

export interface ObjectRelease {
  /** the object's (1) */
  number: number;
}

export interface Chart {
  /** geodetic latitude of the world's origin, WGS 84 (a scenario may leave it to the raster) (deg) */
  origin_latitude_deg: number;
  /** longitude of the world's origin, WGS 84 (deg) */
  origin_longitude_deg: number;
  /** world east of the western edge (m) */
  west_m: number;
  /** world north of the southern edge (m) */
  south_m: number;
  /** world east of the eastern edge (m) */
  east_m: number;
  /** world north of the northern edge (m) */
  north_m: number;
  /** least depth below chart datum, positive down (m) */
  shallowest_m: number;
  /** greatest depth below chart datum, positive down (m) */
  deepest_m: number;
  /** distance between the posts of height_m (m) */
  spacing_m: number;
  /** coarse heights (north x east, south-west first), up; NaN where nothing is known (m) */
  height_m: Numbers<Float32Array>;
}

export interface View {
  /** time of transmission, sim time (ns) */
  stamp_ns: number;
  /** ping number of this head, from 0 (1) */
  ping: number;
  /** component that made the ping, as in ping/1 */
  kind: string;
  /** axis of the head from which beam angles count: down or forward */
  beam_axis: string;
  /** level of each cell (beam x cell), 0: nothing was received, n: level_floor_db + (n - 1) level_step_db (1) */
  level: Numbers<Uint8Array>;
  /** received level, rms, with the added gain, of the value 1 (dB re 1 uPa) */
  level_floor_db: number;
  /** step between values (dB) */
  level_step_db: number;
  /** choice of a cell's level: true its strongest sample, false the mean of their powers */
  peak: boolean;
  /** slant range of the near edge of the first cell (m) */
  first_range_m: number;
  /** length of a cell in slant range (m) */
  cell_m: number;
  /** receive beam axes in the head frame, from beam_axis, positive to starboard (rad) */
  beam_angle_rad: Numbers<Float32Array>;
  /** sound speed by which times became ranges: the head's own (m/s) */
  sound_speed_mps: number;
  /** range setting in force (m) */
  range_m: number;
  /** centre frequency in force (Hz) */
  frequency_hz: number;
  /** pulse length in force (s) */
  pulse_length_s: number;
  /** source level in force, on the axis, rms (dB re 1 uPa^2 at 1 m) */
  source_level_db: number;
  /** S of the head's own gain S log10(R) + 2 A R, for a display that wants it (dB) */
  gain_spreading_db: number;
  /** absorption A of the head's own gain (dB/m) */
  gain_absorption_dbpm: number;
  /** S of the gain S log10(R) + 2 A R that was added for display, R in m and no nearer than 1 m (dB) */
  added_spreading_db: number;
  /** absorption A of the gain that was added (dB/m) */
  added_absorption_dbpm: number;
  /** estimated place of the head at transmission: east, north, up from chart datum (m) */
  position_enu_m: number[];
  /** estimated attitude of the head at transmission: quaternion w, x, y, z; all 0: not known (1) */
  enu_from_head: number[];
  /** altitude above a level seabed by which ranges lie on the ground; 0: they are slant ranges (m) */
  ground_altitude_m: number;
  /** number of pictures that were left out so far because the run waited for the head (1) */
  left_out: number;
  /** beam axes of the ping's valid detections; empty: none are known (rad) */
  find_angle_rad: Numbers<Float32Array>;
  /** slant range of each of these detections, by the head's own sound speed (m) */
  find_range_m: Numbers<Float32Array>;
  /** kind of each of these detections: 1 by amplitude, 2 by phase, 0 neither (1) */
  find_kind: Numbers<Uint8Array>;
}

/** Names of types by the hash in an envelope, in hexadecimal. */
export const TYPES: Record<string, string> = {
  "372eca3c12c04a73": "actuators/1",
  "8cd8dfcad82498f0": "clock_health/1",
  "a5052c0022b98144": "console_state/1",
  "01e9c5843cad59a7": "console_flow/1",
  "d8f4b048f8b65b04": "console_cells/1",
  "05273cc6f0f7bf56": "console_track/1",
  "68fb0375e540f86d": "console_values/1",
  "32acf0c61242d64d": "console_alarms/1",
  "d2524f5428f6d0d3": "console_log/1",
  "47dd42c4267b4152": "console_relief/1",
  "c23a8d6933a1243c": "console_plan/1",
  "b60b0240eb9c24d7": "console_enter/1",
  "14328f1031e6e02e": "console_watch/1",
  "b0a7edc861915429": "console_drawn/1",
  "cfccc6cab0eb7abf": "console_open/1",
  "b84ee2650fe05298": "console_command/1",
  "ea981115c6cef8a9": "console_answer/1",
  "2cf25c955f742ec4": "head_declaration/1",
  "ec8cf9630d43fc33": "pager_declaration/1",
  "e193aa9d820fa1c6": "feed_data/1",
  "8c49360ea9bfbb63": "health/1",
  "bf62e1bec5141cea": "labels/1",
  "a8402b03970e13d9": "energies/1",
  "eed8742b161e86c4": "mark/1",
  "197d1d884c88a73b": "next_line/1",
  "c13186a044162017": "coverage/1",
  "6bf7b8d7631729c0": "pose/1",
  "331bc80fd9d0cf1b": "guidance/1",
  "b251d2cca6f638a9": "helm/1",
  "166c627b9ccdda3b": "mission_state/1",
  "0ec940a0a187b383": "attitude/1",
  "51802885a6b427aa": "position/1",
  "33e3b83879c21338": "sound_speed/1",
  "dae3ea760d7e3dbb": "estimate/1",
  "cea7d2b0d5c8156d": "delayed_heave/1",
  "0092eb477aad29ed": "heading/1",
  "92c56d142e4fe3c2": "inertial_increments/1",
  "517f0711b882197b": "velocity_log/1",
  "f60e54e9a5d4814a": "depth/1",
  "ba8cfe860ac7bcdb": "altitude/1",
  "7be3f736a6c88154": "current_profile/1",
  "411501cf9e205a12": "ctd/1",
  "23b4bc3c2d6f90cf": "usbl_fix/1",
  "212cd776e3e3b699": "ping/1",
  "57a8ba7907e86a16": "bottom_track/1",
  "e57a33d50477ead9": "transmit/1",
  "4dad9971c21dac88": "sonar_settings/1",
  "30d87e13db4f746d": "soundings/1",
  "2aa66cbcd4a6059b": "snippets/1",
  "7f71cbbea9952d59": "seabed_image/1",
  "00554fda365a4399": "tile/1",
  "2f2370dc15b7116f": "tile_release/1",
  "986b58ed17074668": "mesh/1",
  "57fa4ffb33e3549a": "mesh_release/1",
  "027f8101de6d4b3a": "object/1",
  "508fbc609d864922": "object_mesh/1",
  "3ef4c39fab731150": "object_release/1",
  "5deca177e9e573c7": "chart/1",
  "37f38ac623519acc": "view/1",
};
