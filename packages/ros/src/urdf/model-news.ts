/** What topics say of the robot's body. */
import type { RobotModel } from './read-urdf.ts';
import type { UrdfFault } from './urdf-fault.ts';

/** What a description says: a model, or why there is none. */
export type ModelNews = { kind: 'model'; model: RobotModel } | { kind: 'refused'; fault: UrdfFault };

/** Where joints are, by their names: radians or metres. */
export type JointNews = readonly (readonly [name: string, position: number])[];
