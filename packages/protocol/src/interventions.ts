/** Why a robot moves more slowly than it was told to, or not at all, although it takes the operator's commands. */
export const interventions = [
  'view-unknown', // the operator's page does not say what it shows
  'view-late', // what the operator sees is old: slower
  'view-lost', // what the operator sees is too old: the robot brakes
  'blind-travel', // it would go too far between what the operator sees and standing still: slower
  'obstacle-near', // something is near on the way: slower
  'obstacle', // something is in the way: the robot brakes
  'drop-off', // the floor ahead is missing: the robot brakes
  'unseen-space', // no sensor sees where the robot is to go: slower
  'sensor-silent', // a sensor that looks where the robot goes gives nothing: slower
  'collision-topic', // another program on the robot demands that it be slower, or stop
  'collision-silent', // that program says nothing: slower, or the robot brakes
  'fence-near', // near the edge of the area in which it may move, or in a slow one
  'fence', // the edge of the area in which it may move
] as const;
/**
 * Why a robot moves more slowly than it was told to, or not at all, although it takes the operator's commands.
 *
 * @useDeclaredType
 */
export type Intervention = (typeof interventions)[number];
