/** The robot's model, which operators see. */
import { defineOption, schema } from '@farpoint/service';

export const modelOptions = {
  urdf: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'the robot’s model for operators: a URDF file, or none; default: of a topic with `as: model`, and the simulated robot’s own',
  }),
};
