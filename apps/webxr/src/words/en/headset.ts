/** What is said in the headset, and about entering it. */
import type { Hand, HeadsetView } from '../../ground/headset-settings.ts';

export const headset = {
  hands: { left: 'left', right: 'right' } satisfies Record<Hand, string>,
  views: {
    'first-person': 'First person',
    'over-shoulder': 'Over the shoulder',
    tabletop: 'Tabletop',
  } satisfies Record<HeadsetView, string>,
  /** Within a list. */
  viewNames: {
    'first-person': 'first person',
    'over-shoulder': 'over the shoulder',
    tabletop: 'tabletop',
  } satisfies Record<HeadsetView, string>,
  viewBegins: {
    'first-person': 'View in the headset: first person',
    'over-shoulder': 'View in the headset: over the shoulder',
    tabletop: 'View in the headset: tabletop',
  } satisfies Record<HeadsetView, string>,
  tabletopHint: (hand: string) => `Trigger: move · both: turn, scale · squeeze ${hand}: drive`,
  turnHint: (hand: string) => `Other stick: turn · squeeze ${hand}: drive`,
  /** What stands before the eyes. */
  answerOutside: (text: string) => `${text} To answer, leave VR: the buttons are on the page.`,
  release: 'To release it, open both hands, then hold a trigger for one second.',
  noRobot: 'No robot is chosen',
  pressToConnect: (hand: string, robot: string) => `Press the ${hand} stick to connect to ${robot}.`,
  /** On the wrist: short lines. */
  noPoints: (none: string) => `points ${none}`,
  stream: (points: string, rate: string, mbps: string) => `${points}k points  ${rate}/s  ${mbps} Mbit/s`,
  trip: (trip: string, none: string) => `rtt ${trip}  view ${none}  loss ${none}`,
  tripAndLoss: (trip: string, age: string, loss: string) => `rtt ${trip}  view ${age} old  loss ${loss}`,
  releasedAtRobot: 'Released at the robot only',
  stopUnheard: 'STOP, as last heard',
  releaseHint: 'Release: open hand, hold trigger 1 s',
  pressFor: (hand: string, robot: string) => `press ${hand} stick: ${robot}`,
  driveHint: (hand: string) => `Squeeze ${hand}: drive  B: stop`,
  battery: (charge: string) => `Battery ${charge}`,
  /** On the page. */
  enterVr: 'Enter VR',
  leave: (name: string) => `Leave ${name}`,
  couldNotEnter: (name: string, why: string) => `Could not enter ${name}: ${why}`,
  needsHttps: 'VR needs https: open the page at its https address.',
  noWebXr: 'This browser has no WebXR. To use VR, open the page in a headset’s browser.',
  noHeadset: 'No headset found.',
  /** On the sign before the eyes. @param asked what another operator wants */
  answer: (asked: string) => `${asked}. Answer in the menu.`,
  /** After the words on which press connects to a robot. */
  otherRobots: 'The menu lists all robots.',
  releaseInMenu: 'To release it, close the menu, open both hands, then hold a trigger for one second.',
  settingsOutside: 'The settings are on the page: leave VR for them.',
  notLoaded: 'The menu could not be loaded. Check the network, then leave VR and reload the page.',
};
