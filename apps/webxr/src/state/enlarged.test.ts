import { signal } from '@preact/signals-core';
import { expect, test } from 'vitest';
import type { CameraView } from '../ground/pictures/camera-view.ts';
import { Enlarged } from './enlarged.ts';

function bench() {
  const cameras = ['front', 'rear', 'roof'].map((name, index) => ({ index, name, on: signal(true) }));
  const views = signal(cameras.map((camera) => ({ camera }) as unknown as CameraView));
  const enlarged = new Enlarged(views);
  return { cameras, views, enlarged, shown: () => enlarged.view.value?.camera.name ?? null };
}

test('the key goes through the cameras that are shown, then to none', () => {
  const { cameras, enlarged, shown } = bench();
  cameras[1]!.on.value = false;
  const seen = [shown()];
  for (let i = 0; i < 4; i++) {
    enlarged.next();
    seen.push(shown());
  }
  expect(seen).toEqual([null, 'front', 'roof', null, 'front']);
});

test('a click enlarges a camera or reduces it; one that is hidden or gone is not enlarged', () => {
  const { cameras, views, enlarged, shown } = bench();
  enlarged.toggle(views.value[1]!);
  expect(shown()).toBe('rear');
  enlarged.toggle(views.value[2]!);
  expect(shown()).toBe('roof');
  enlarged.toggle(views.value[2]!);
  expect(shown()).toBe(null);
  enlarged.toggle(views.value[2]!);
  cameras[2]!.on.value = false;
  expect(shown()).toBe(null);
  enlarged.next();
  expect(shown()).toBe('front');
  views.value = [];
  expect(shown()).toBe(null);
  enlarged.next();
  expect(shown()).toBe(null);
});
