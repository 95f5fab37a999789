/** Applies what people have chosen about clouds to what draws them. */
import type { RobotClient } from '@farpoint/operator';
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { type CloudAppearance, UNNAMED } from '../state/cloud-appearance.ts';
import type { Switches } from '../state/switches.ts';
import type { RememberedWorld } from './remembered-world.ts';
import type { SensorClouds } from './sensor-clouds.ts';
import type { Stage } from './stage.ts';

export interface AppearanceParts {
  readonly appearance: CloudAppearance;
  readonly sensors: Switches;
  /** What the robot says about each sensor's rings, by the sensor's number. */
  readonly rings: ReadonlySignal<ReadonlyMap<number, readonly number[]>>;
  readonly clouds: SensorClouds;
  readonly stage: Pick<Stage, 'look' | 'headingUp'>;
  readonly inVr: ReadonlySignal<boolean>;
  readonly client: Pick<RobotClient, 'drawSurface'>;
  readonly remembered: Pick<RememberedWorld, 'on'>;
  /** Whether clouds are drawn as surfaces, and what was seen is remembered, until somebody chooses. */
  readonly drawsFast: boolean;
}

export function applyAppearance(parts: AppearanceParts): void {
  const { appearance, sensors, rings, clouds, stage, inVr, client, remembered, drawsFast } = parts;
  effect(() => client.drawSurface(appearance.surface.value ?? drawsFast));
  effect(() => {
    remembered.on = appearance.memory.value ?? drawsFast;
  });
  const { fromAbove, headingUp, cut, cutFromAbove } = appearance;
  effect(() => {
    for (const [i, { colouring }] of clouds.all.value.entries()) {
      const { mode, fixed } = appearance.lookOf(sensors.all.value[i]?.name ?? UNNAMED);
      colouring.mode = mode;
      colouring.fixedRange = fixed;
      colouring.knownRings = rings.value.get(i) ?? null;
    }
  });
  effect(() => {
    const inUse = fromAbove.value && !inVr.value ? cutFromAbove.value : cut.value;
    for (const { colouring } of clouds.all.value) colouring.cut = inUse;
  });
  effect(() => {
    stage.look.fromAbove = fromAbove.value;
    stage.headingUp = headingUp.value;
  });
}
