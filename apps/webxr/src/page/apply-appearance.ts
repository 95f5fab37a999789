/** Applies what people have chosen about clouds to what draws them. */
import type { RobotClient } from '@farpoint/operator';
import { effect, type ReadonlySignal } from '@preact/signals-core';
import type { Switches } from '../ground/switches.ts';
import type { RememberedWorld } from '../panels/ui/remembered-world.ts';
import type { SensorClouds } from '../scene/view/sensor-clouds.ts';
import { SensorFrusta } from '../scene/view/sensor-frusta.ts';
import { showHazards } from '../scene/view/show-hazards.ts';
import type { Stage } from '../scene/view/stage.ts';
import { type CloudAppearance, UNNAMED } from '../state/cloud-appearance.ts';

export interface AppearanceParts {
  readonly appearance: CloudAppearance;
  readonly sensors: Switches;
  /** What the robot says about each sensor's rings, by the sensor's number. */
  readonly rings: ReadonlySignal<ReadonlyMap<number, readonly number[]>>;
  readonly clouds: SensorClouds;
  readonly stage: Pick<Stage, 'look' | 'headingUp' | 'world'>;
  readonly inVr: ReadonlySignal<boolean>;
  /** Whether the headset shows the world as a model, seen from above. */
  readonly inTabletop: ReadonlySignal<boolean>;
  readonly client: Pick<RobotClient, 'drawSurface' | 'on' | 'link'>;
  readonly remembered: Pick<RememberedWorld, 'on' | 'headingUp'>;
}

export function applyAppearance(parts: AppearanceParts): void {
  const { appearance, sensors, rings, clouds, stage, inVr, inTabletop, client, remembered } = parts;
  effect(() => client.drawSurface(appearance.drawsSurface.value));
  effect(() => {
    remembered.on = appearance.remembers.value;
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
    const isFromAbove = inVr.value ? inTabletop.value : fromAbove.value;
    const inUse = isFromAbove ? cutFromAbove.value : cut.value;
    for (const { colouring } of clouds.all.value) colouring.cut = inUse;
  });
  showHazards({ client, clouds, appearance });
  const frusta = new SensorFrusta();
  stage.world.add(frusta.object);
  effect(() => {
    const shown = clouds.all.value.filter((_, i) => sensors.all.value[i]?.on.value ?? true);
    frusta.show(appearance.frusta.value ? shown : []);
  });
  effect(() => {
    stage.look.fromAbove = fromAbove.value;
    stage.headingUp = headingUp.value;
    remembered.headingUp = headingUp.value;
  });
}
