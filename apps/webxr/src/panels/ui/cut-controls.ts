/** Which heights of the clouds are drawn in the present view; and what is up when looking from above. */
import type { HeightCut } from '@farpoint/cloud-view';
import { effect } from '@preact/signals-core';
import type { CloudAppearance } from '../../state/cloud-appearance.ts';
import { quietButton, rowOf, sliderOf } from './panel-parts.ts';

/** Metres above the robot's ground. The outer end of each slider draws everything. */
const ABOVE = { min: 0, max: 6, step: 0.1 };
const BELOW = { min: -2, max: 2, step: 0.1 };

export function cutControls(appearance: CloudAppearance): HTMLElement {
  const group = document.createElement('div');
  const inUse = () => (appearance.fromAbove.value ? appearance.cutFromAbove : appearance.cut);
  const change = (part: Partial<HeightCut>) => {
    const cut = inUse();
    cut.value = { ...cut.peek(), ...part };
  };
  const above = sliderOf('Hide points above', ABOVE, (height) =>
    change({ above: height >= ABOVE.max ? null : height }),
  );
  const below = sliderOf('Hide points below', BELOW, (height) =>
    change({ below: height <= BELOW.min ? null : height }),
  );
  const [aboveText, belowText] = [document.createElement('output'), document.createElement('output')];
  const up = quietButton(
    'Heading up',
    'What is up: the heading of the robot, or north (the world’s y)',
    () => {
      appearance.headingUp.value = !appearance.headingUp.peek();
    },
  );
  const upRow = rowOf('Up', up);
  group.append(rowOf('Hide above', above, aboveText), rowOf('Hide below', below, belowText), upRow);
  effect(() => {
    const cut = inUse().value;
    above.value = String(cut.above ?? ABOVE.max);
    below.value = String(cut.below ?? BELOW.min);
    aboveText.value = heightText(cut.above);
    belowText.value = heightText(cut.below);
  });
  effect(() => {
    upRow.hidden = !appearance.fromAbove.value;
    up.textContent = appearance.headingUp.value ? 'Heading up' : 'North up';
  });
  return group;
}

function heightText(height: number | null): string {
  return height === null ? 'nothing' : `${height.toFixed(1)} m`;
}
