/** What is said about the robot's own bounds on motion, about what is near it, and about how it is seen. */

import type { Intervention, ReturnEnd } from '@farpoint/protocol';
import type { Direction } from '../../ground/near-field/directions.ts';

export const motion = {
  /** Why the robot is not where its driver has left it. */
  aboutToReturn: 'The link was lost: the robot is about to drive back',
  returning: 'The link was lost: the robot drives back along its track',
  stayed: 'The link was lost; the robot stayed',
  cameBack: (metres: string) => `The link was lost; it came back ${metres} m`,
  returnEnds: {
    'service-back': 'until somebody was heard again',
    estop: 'until the emergency stop',
    'track-end': 'to the beginning of its track',
    moved: 'something else moved it',
    'no-track': 'it knew no way',
    'off-track': 'until it was off its track',
    'odometry-silent': 'until it did not know where it was',
    'sensor-silent': 'until a sensor gave nothing',
    unseen: 'until no sensor saw the way',
    blocked: 'until something was in the way',
    'no-wheels': 'until nothing took its velocities',
    'too-long': 'until its time was up',
  } satisfies Record<ReturnEnd, string>,
  /** Why the robot does less than it is told. `age` of what the operator sees; `most`: m/s. */
  reasons: {
    'view-unknown': () => 'The robot waits until you see it',
    'view-late': ({ age }) => `Slower: what you see is ${age} old`,
    'view-lost': () => 'Held: what you see is too old. Let go, then drive',
    'blind-travel': ({ age, most }) => `At most ${most} m/s: what you see is ${age} old`,
    'obstacle-near': () => 'Slower: something is near',
    obstacle: () => 'Held: something is in the way',
    'drop-off': () => 'Held: the floor ahead is missing',
    'unseen-space': () => 'Slower: no sensor sees where you are going',
    'sensor-silent': () => 'Slower: a sensor gives nothing',
    'collision-topic': ({ held }): string =>
      held
        ? 'Held: the robot’s collision sensor demands it'
        : 'Slower: the robot’s collision sensor demands it',
    'collision-silent': ({ held }): string =>
      held
        ? 'Held: the robot’s collision sensor says nothing'
        : 'Slower: the robot’s collision sensor says nothing',
    'fence-near': () => 'Slower: near the edge of the permitted area',
    fence: () => 'Held: the edge of the permitted area',
  } satisfies Record<Intervention, (facts: { age: string; most: string; held: boolean }) => string>,
  /** The same in a few words: why it may go no faster now. */
  shortReasons: {
    'view-unknown': () => 'it waits until you see it',
    'view-late': (age) => `what you see is ${age} old`,
    'view-lost': () => 'what you see is too old',
    'blind-travel': (age) => `what you see is ${age} old`,
    'obstacle-near': () => 'something is near',
    obstacle: () => 'something is in the way',
    'drop-off': () => 'the floor ahead is missing',
    'unseen-space': () => 'no sensor sees the way',
    'sensor-silent': () => 'a sensor gives nothing',
    'collision-topic': () => 'its collision sensor demands it',
    'collision-silent': () => 'its collision sensor says nothing',
    'fence-near': () => 'the edge of the permitted area is near',
    fence: () => 'the edge of the permitted area',
  } satisfies Record<Intervention, (age: string) => string>,
  seenOld: (age: string) => `what you see is ${age} old`,
  slower: 'slower',
  atMost: (speed: string) => `at most ${speed}`,
  held: 'held',
  /** @param speed e.g. 0.30 m/s @param bound e.g. at most 0.50 */
  speed: (speed: string, bound: string) => `${speed}, ${bound}`,
  speedWhy: (speed: string, bound: string, why: string) => `${speed}, ${bound}: ${why}`,
  guardOff: 'The robot does not brake for obstacles',
  guardBlind: 'The robot cannot see obstacles now',
  /** What is near the robot. */
  near: {
    noData: 'No near-field data',
    nothing: 'Nothing near that sensors see',
    old: (age: string, what: string) => `${age} s old: ${what}`,
    atEdge: (where: string) => `at its edge, ${where}`,
    at: (metres: string, where: string) => `${metres} m ${where}`,
    drop: (where: string) => `drop ${where}`,
    unseenAllAround: 'unseen all around',
    unseen: (where: readonly string[]) => `unseen: ${where.join(', ')}`,
    directions: {
      ahead: 'ahead',
      'ahead left': 'ahead left',
      left: 'left',
      'behind left': 'behind left',
      behind: 'behind',
      'behind right': 'behind right',
      right: 'right',
      'ahead right': 'ahead right',
    } satisfies Record<Direction, string>,
  },
  /** What the tints of hazards mean. */
  hazards: {
    unknown: 'hazards: robot’s height unknown',
    hit: (from: string, to: string) => `would hit: ${from}–${to} m`,
    drop: (below: string) => `drop: below −${below} m`,
    off: 'Hazards are not tinted.',
    cannot: 'Hazards cannot be tinted: this robot does not say which heights matter to it.',
    on: 'Red: the robot would hit it. Violet: the floor is missing.',
    hintUnknown: 'No hazard tint',
    hint: 'Red: would hit  violet: drop',
  },
  /** Whether what is shown is where the robot reported itself. */
  view: {
    predicted: (ms: number) => `Predicted ${ms} ms ahead`,
    off: 'As reported: prediction is off (P)',
    held: 'As reported: the robot is held',
    stale: 'As reported: nothing new is heard',
    reported: 'As reported',
    lead: (ms: number) => `  view +${ms} ms predicted`,
    on: 'The view is led by your commands: a prediction, corrected by the robot.',
    switchedOff: 'The view shows where the robot last reported itself.',
  },
  /** The navigator's path and map. */
  oldNotDrawn: (what: string, age: string) => `${what}, ${age} old: not drawn`,
  silentNotDrawn: (what: string, time: string) => `${what}, not heard for ${time}: not drawn`,
  aged: (what: string, age: string) => `${what}, ${age} old`,
};
