/** What stands in the headset's menu. */
export const menuWords = {
  title: 'Menu',
  stop: 'STOP the robot',
  stopAgain: 'STOP is on: press again',
  choose: 'Choose a robot…',
  change: 'Change robot…',
  robots: 'Robots',
  noRobot: 'No robot is here yet. It appears as soon as it is.',
  more: 'More robots…',
  disconnect: 'Disconnect from this robot',
  view: 'View',
  cameras: 'Cameras…',
  camera: (name: string, on: boolean) => `${name}: ${on ? 'shown' : 'hidden'}`,
  commands: 'Robot commands…',
  moreCommands: 'More commands…',
  barred: (command: string, why: string) => `${command}: ${why}`,
  readings: (on: boolean) => `Readings on the wrist: ${on ? 'all' : 'few'}`,
  takeOver: 'Take over the drive',
  handBack: 'Hand back the drive',
  askToDrive: 'Ask to drive',
  offer: 'Offer the drive…',
  offerTo: 'Offer the drive to',
  nobodyToOffer: 'Nobody is here who may drive.',
  morePeople: 'More people…',
  latency: 'Latency test',
  recentre: 'Recentre',
  leave: (passthrough: boolean) => `Leave ${passthrough ? 'AR' : 'VR'}`,
  close: 'Close this menu',
  back: 'Back',
} as const;

/** On the wrist, for hands without a button for it. */
export const tabWords = { stop: 'STOP', menu: 'Menu' } as const;
