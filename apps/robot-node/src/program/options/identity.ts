/** The robot's identity, and its role in the system that it runs on. */
import { displayNameSchema, robotIdSchema } from '@farpoint/protocol';
import { defineOption, type OptionTable, schema } from '@farpoint/service';

export const identityOptions = {
  id: defineOption({
    schema: robotIdSchema,
    default: 'robot-1',
    argument: 'ID',
    help: 'the robot’s id at the signaling service: a–z 0–9 . _ -',
  }),
  name: defineOption({
    schema: displayNameSchema,
    default: 'Robot',
    argument: 'NAME',
    help: 'name that operators see',
  }),
  niceness: defineOption({
    schema: schema.integer({ min: -20, max: 19 }),
    default: -5,
    argument: 'N',
    help: 'priority of this process, if the system permits it; commands and packets should not wait for the processor',
  }),
} satisfies OptionTable;

/** The robot’s model, which operators see. */
export const modelOptions = {
  urdf: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'the robot’s model for operators: a URDF file, or none; default: of a topic with `as: model`, and the simulated robot’s own',
  }),
};
