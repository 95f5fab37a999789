import { signal } from '@preact/signals-core';
import { expect, test } from 'vitest';
import type { CameraView } from '../ground/pictures/camera-view.ts';
import { Staged } from './page-state.ts';

const camera = (name: string) => ({ camera: { name, on: signal(true) } }) as unknown as CameraView;

test('one key: the enlarged camera or the first fills the screen, and then the cloud again', () => {
  const [front, rear] = [camera('front'), camera('rear')];
  const staged = new Staged(signal([front, rear]), signal(true));
  staged.swap(null);
  expect(staged.view.value).toBe(front);
  staged.swap(rear);
  expect(staged.view.value).toBe(null);
  staged.swap(rear);
  expect(staged.view.value).toBe(rear);
  staged.toggle(front);
  expect(staged.view.value).toBe(front);
});

test('the cloud is back when the camera is switched off, or the session is over', () => {
  const front = camera('front');
  const live = signal(true);
  const staged = new Staged(signal([front]), live);
  staged.swap(null);
  live.value = false;
  expect(staged.view.value).toBe(null);
  live.value = true;
  (front.camera.on as unknown as { value: boolean }).value = false;
  expect(staged.view.value).toBe(null);
  // Nothing to show: nothing happens.
  new Staged(signal([]), live).swap(null);
});
