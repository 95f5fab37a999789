/**
 * Draws the clouds that `@farpoint/operator` receives, in a three.js scene. Begin with {@link CloudView}.
 *
 * @module cloud-view
 */
export type { CloudSource } from '@farpoint/operator';
export { bodyYaw } from '@farpoint/protocol';
export { opticalYaw, RobotWorld, worldToThree } from './axes.ts';
export {
  type CloudColouring,
  COLOUR_MODES,
  type ColourMode,
  type HeightCut,
  type Rings,
  type ValueRange,
} from './cloud-colouring.ts';
export type { CameraPicture, CloudPaint, PictureUse } from './cloud-paint.ts';
export { CloudView, type CloudViewOptions } from './cloud-view.ts';
export { COLOUR_STOPS, colourAt, colourStops, type Rgb } from './colour-map.ts';
export { ALL_FRAMES_PER_SECOND, DisplayMeter } from './display-meter.ts';
export { DrawGate } from './draw-gate.ts';
export { DrawingGovernor, type DrawingStep } from './drawing-governor.ts';
export type { DrawnPoints, FramePose } from './drawn-points.ts';
export { GpuCompletion } from './gpu-completion.ts';
export { DROP_TINT, type Hazards, HIT_TINT } from './hazards.ts';
export { MEMORY_OLD_S } from './memory-material.ts';
export { type MemorySource, MemoryView } from './memory-view.ts';
export { isSoftwareRenderer } from './renderer-facts.ts';
export { RING_COLOURS, ringColours } from './ring-colours.ts';
export type { SceneFigures } from './scene-estimate.ts';
export { LIT_AMBIENT } from './surface-normal.ts';
export { type Stride, strideFor } from './tile-geometry.ts';
export { WorstGap } from './worst-gap.ts';
