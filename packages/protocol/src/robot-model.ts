/**
 * The robot's model: its moving links and their shapes, `robotModel` on the `session` channel, and where its joints are,
 * `joints` on the `telemetry` channel. The robot has made it from its URDF: nobody else parses one.
 */
import * as z from 'zod/mini';
import { uint32Schema } from './identifiers.ts';

/** Links of a model that move against another; link 0, the base, is not one of them. */
export const MAX_MODEL_LINKS = 128;
/** Shapes of a model. */
export const MAX_MODEL_SHAPES = 512;
/** No place and no size of a model is larger, metres. */
export const MAX_MODEL_M = 100;
/** No joint has turned (rad) or slid (m) farther. */
export const MAX_JOINT_POSITION = 1000;
/** Parts in one message. */
const MAX_PARTS = 32;

/** A pose in a link, as numbers: metres, then the unit quaternion. */
export type ModelPlace = [x: number, y: number, z: number, qx: number, qy: number, qz: number, qw: number];

/** A link that moves against another. The first of them is link 1. */
export interface ModelLink {
  /** Tells it from a shape. */
  part: 'link';
  /** The link against which it moves: 0, the base (base_link), or one that was told before. */
  parent: number;
  /** Its pose in that link while its joint is at 0. */
  place: ModelPlace;
  /** How it moves along or about its axis. */
  moves: 'turns' | 'slides';
  /** Unit vector in the link's own axes. */
  axis: [x: number, y: number, z: number];
}

/** A shape of a link. */
export interface ModelShape {
  /** Tells it from a link. */
  part: 'shape';
  /** The link to which it belongs, told before; 0: the base. */
  link: number;
  /** Pose of its middle in the link. A cylinder stands along z. */
  place: ModelPlace;
  /** What it is. */
  form: 'box' | 'cylinder' | 'sphere';
  /** Metres: a box's x, y and z; a cylinder's radius and length; a sphere's radius. */
  size: number[];
  /** sRGB, 24 bits. */
  colour: number;
}

/** A part of a model. */
export type ModelPart = ModelLink | ModelShape;

/** Some parts of the robot's model. */
export interface RobotModelParts {
  type: 'robotModel';
  /** Names the model: parts of another number belong to another model. Wraps at 2³². */
  number: number;
  /** Parts of the whole model; 0: the robot has none any more. */
  count: number;
  /** How many of its parts were told before. */
  at: number;
  /** The links first, then the shapes. */
  parts: ModelPart[];
}

/** Where the joints of the robot's model are. */
export interface JointPositions {
  type: 'joints';
  /** The model to which they belong. */
  model: number;
  /** When the robot received them, by its monotonic clock, ms. */
  timeMs: number;
  /** Time since then, ms. */
  ageMs: number;
  /** Of each moving link, in their order: radians or metres. */
  positions: number[];
}

const FORM_SIZES: Readonly<Record<ModelShape['form'], number>> = { box: 3, cylinder: 2, sphere: 1 };

const metresSchema = z.number().check(z.minimum(-MAX_MODEL_M), z.maximum(MAX_MODEL_M));
const shareSchema = z.number().check(z.minimum(-1), z.maximum(1));
const [m, q] = [metresSchema, shareSchema];
const placeSchema = z
  .tuple([m, m, m, q, q, q, q])
  .check(
    z.refine(([, , , ...turn]) => isUnit(turn), 'must be metres and a unit quaternion'),
  ) satisfies z.ZodMiniType<ModelPlace>;

const linkSchema = z.strictObject({
  part: z.literal('link'),
  parent: z.int().check(z.minimum(0), z.maximum(MAX_MODEL_LINKS - 1)),
  place: placeSchema,
  moves: z.enum(['turns', 'slides']),
  axis: z
    .tuple([shareSchema, shareSchema, shareSchema])
    .check(z.refine((axis) => isUnit(axis), 'must be a unit vector')),
}) satisfies z.ZodMiniType<ModelLink>;

const shapeSchema = z
  .strictObject({
    part: z.literal('shape'),
    link: z.int().check(z.minimum(0), z.maximum(MAX_MODEL_LINKS)),
    place: placeSchema,
    form: z.enum(['box', 'cylinder', 'sphere']),
    size: z.array(z.number().check(z.positive(), z.maximum(MAX_MODEL_M))).check(z.maxLength(3)),
    colour: z.int().check(z.minimum(0), z.maximum(0xffffff)),
  })
  .check(
    z.refine(({ form, size }) => size.length === FORM_SIZES[form], {
      path: ['size'],
      error: 'must have as many numbers as the form',
    }),
  ) satisfies z.ZodMiniType<ModelShape>;

export const robotModelSchema = z
  .strictObject({
    type: z.literal('robotModel'),
    number: uint32Schema,
    count: z.int().check(z.minimum(0), z.maximum(MAX_MODEL_LINKS + MAX_MODEL_SHAPES)),
    at: z.int().check(z.minimum(0)),
    parts: z.array(z.discriminatedUnion('part', [linkSchema, shapeSchema])).check(z.maxLength(MAX_PARTS)),
  })
  .check(
    z.refine(({ count, at, parts }) => at + parts.length <= count, {
      path: ['parts'],
      error: 'must be parts of the model',
    }),
  ) satisfies z.ZodMiniType<RobotModelParts>;

export const jointPositionsSchema = z.strictObject({
  type: z.literal('joints'),
  model: uint32Schema,
  timeMs: z.number().check(z.minimum(0)),
  ageMs: z.number().check(z.minimum(0)),
  positions: z
    .array(z.number().check(z.minimum(-MAX_JOINT_POSITION), z.maximum(MAX_JOINT_POSITION)))
    .check(z.maxLength(MAX_MODEL_LINKS)),
}) satisfies z.ZodMiniType<JointPositions>;

/** Within 1 %, as of other orientations. */
function isUnit(numbers: readonly number[]): boolean {
  return Math.abs(Math.hypot(...numbers) - 1) < 0.01;
}
