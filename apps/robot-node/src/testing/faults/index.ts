/** What goes wrong while a robot is driven, for robots of any kind: real programs, and all in virtual time. */
export { brakingFaults } from './braking-faults.ts';
export {
  BRAKES_MS,
  type Driving,
  type Fault,
  type FaultLink,
  type FaultOperator,
  type FaultyHand,
  type FaultyRobot,
  type LinkChange,
} from './fault.ts';
export { harmlessFaults } from './harmless-faults.ts';
export { type ReturningFault, returningFaults } from './returning-faults.ts';
