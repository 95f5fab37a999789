/** What the help says besides the names of roles, keys and buttons. */

export const helpGroupTitles = {
  drive: 'Drive',
  stop: 'Stop',
  views: 'Views',
  cameras: 'Cameras',
  panels: 'Panels and more',
} as const;

/** What is done by mouse or finger. Those that have the name of a key's role stand beside its keys. */
export const gestureWords = {
  grip: { what: 'Grip', hand: 'touch: a finger on the joystick is the grip' },
  forward: { what: 'Forward', hand: 'touch: push the joystick' },
  slower: { what: 'Lower gear', hand: 'the slider beside the controls' },
  faster: { what: 'Higher gear', hand: 'the button with the per cent shows the next gear' },
  'go-to': { what: 'Go to', hand: 'Go to, then click on the floor; drag to say where it looks' },
  estop: { what: 'STOP', hand: 'press STOP; while it has the focus, Space or Enter' },
  release: { what: 'Release STOP', hand: 'hold the release button for one second' },
  look: { what: 'Look around', hand: 'drag over the picture' },
  zoom: { what: 'Nearer, farther', hand: 'the wheel, or two fingers' },
  recentre: { what: 'Centre the view', hand: 'double click on the picture' },
  view: { what: 'First or third person', hand: 'View, in the bar' },
  enlarge: { what: 'Enlarge a camera', hand: 'click on its picture' },
  swap: { what: 'Camera instead of cloud', hand: '⇄ at its name' },
  'move-panel': { what: 'Move a camera', hand: 'drag its name, or the arrow keys while it has the focus' },
  'resize-panel': { what: 'Resize a camera', hand: 'drag its corner, or + and − while it has the focus' },
  dashboard: { what: 'Dashboard', hand: 'Dashboard, in the bar; an alarm opens it' },
  'latency-test': { what: 'Latency test', hand: 'Latency test, below the picture' },
  talk: { what: 'Talk', hand: 'hold Hold to talk' },
  'next-robot': { what: 'Next robot', hand: 'the list of robots, in the bar' },
  'save-scene': { what: 'Save the picture', hand: 'Save picture, here' },
  'save-clip': { what: 'Save the last 30 seconds', hand: 'Save clip, here' },
  help: { what: 'Help', hand: 'Help, in the bar' },
  close: { what: 'Close a dialog', hand: 'Escape' },
} as const;
export type Gesture = keyof typeof gestureWords;

export const helpWords = {
  lead: 'As keys and controllers are set now. The robot moves only while the grip is held, and does not move while this is open.',
  noController: 'No controller is connected: this is what a gamepad does at first.',
  headset: 'In a headset, labels at the controllers say what each button does.',
  none: 'no key',
} as const;
