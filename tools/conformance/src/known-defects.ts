/**
 * Defects of the reference system's released programs, by name. At level `reference`, a program may have them and each
 * is reported; at level `strict`, it may have none.
 */
export const knownDefects = {
  // Signaling
  'robot-0-dropped': '0 counts as no id: offers, candidates and deregistrations of robot 0 are dropped',
  'farewell-without-id': 'an explicit deregistration is pushed without the robot’s id, not as deregistered',
  'one-client': 'only the client that connected last is notified of changes',
  'any-socket-for-any-robot': 'any robot’s socket may offer for another robot, or end its registration',
  'garbage-ends-signaling': 'a message that is not a JSON object ends the program',
  // Robot
  'streams-unasked': 'a robot that one operator started streams to the next one unasked',
  // Bridge
  'frame-waits-for-next': 'a frame is sent only when the next one’s first packet arrives',
  'partial-block-lost': 'a last packet that is not full loses its points',
  'order-of-arrival': 'points are in the order in which their packets arrived',
  'doubled-points': 'a duplicated packet counts as two',
  'late-in-wrong-frame': 'a late packet ends the present frame',
  'reads-what-is-no-packet': 'data that is not a packet is shown as points',
  'shows-nobody': 'switchRobot with an unknown id hides the robot that is shown',
  'command-breaks-socket': 'a command for a robot whose channel is not open ends the page’s socket',
  'offer-ends-bridge': 'an unreadable offer ends the program',
} as const;

export type KnownDefect = keyof typeof knownDefects;
