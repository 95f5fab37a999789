/** The menu in the headset. */

export const headsetMenu = {
  title: 'Menu',
  /** On the wrist, for a hand that points. */
  tab: { stop: 'STOP', menu: 'Menu' },
  stop: 'STOP the robot',
  stopAgain: 'STOP is on: press it again',
  robots: 'Robots',
  /** A robot in the list. @param chosen the page is connected to it, or tries to be */
  robot: (name: string, chosen: boolean) => (chosen ? `${name} (chosen)` : name),
  offline: (id: string) => `${id} (offline)`,
  view: 'View',
  viewNow: (view: string) => `View: ${view}`,
  cameras: 'Cameras',
  camera: {
    hidden: (name: string) => `${name}: hidden`,
    shown: (name: string) => `${name}: at the wrist`,
    enlarged: (name: string) => `${name}: enlarged`,
    filling: (name: string) => `${name}: in place of the cloud`,
  },
  cameraShow: 'Show',
  cameraHide: 'Hide',
  cameraEnlarge: 'Enlarge',
  cameraShrink: 'Back to the wrist',
  cameraFill: 'In place of the cloud',
  readings: 'Readings',
  noReadings: 'The robot sends no readings.',
  reading: (label: string, text: string) => `${label}: ${text}`,
  times: 'Where the time goes',
  clouds: 'Clouds',
  commands: 'Commands',
  stage: (name: string, median: string, p95: string) => `${name}: ${median}, 95 % within ${p95}`,
  /** Below a command that runs. @param note what else is said of it; may be empty */
  progress: (percent: number, note: string) => (note === '' ? `${percent} %` : `${percent} %, ${note}`),
  latency: 'Latency test',
  takeOver: 'Take over',
  ask: 'Ask to drive',
  handOver: 'Hand over',
  giveUp: 'Give up the drive',
  offerTo: (person: string) => `Offer it to ${person}`,
  takeBack: 'Take it back',
  /** @param seconds until it ends by itself */
  left: (text: string, seconds: number) => `${text} (${seconds} s)`,
  point: 'Point at the floor',
  /** What there is to do then. */
  pointNow: 'Aim at the floor, then pinch or pull the trigger.',
  recentre: 'Recentre',
  disconnect: 'Disconnect',
  leave: { vr: 'Leave VR', ar: 'Leave AR' },
  close: 'Close the menu',
  back: 'Back',
  more: 'More',
};
