import { signal } from '@preact/signals-core';
import type { CanvasTexture } from 'three';
import { expect, test } from 'vitest';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import { PictureSheet } from './picture-sheet.ts';

test('a picture is uploaded once, and an old or faulty one is grey', () => {
  const newest = signal<{ number: number } | null>(null);
  const [stale, fault] = [signal(false), signal<string | null>(null)];
  const canvas = { width: 640, height: 480 };
  const sheet = new PictureSheet({ canvas, newest, stale, fault } as unknown as CameraView);
  const { mesh } = sheet;
  const texture = mesh.material.map as CanvasTexture;
  expect([sheet.update(0.4), mesh.visible]).toEqual([0, false]);
  newest.value = { number: 1 };
  expect(sheet.update(0.4)).toBeCloseTo(0.3);
  const uploads = texture.version;
  sheet.update(0.4);
  sheet.update(0.8);
  expect(texture.version).toBe(uploads);
  newest.value = { number: 2 };
  sheet.update(0.4);
  expect(texture.version).toBe(uploads + 1);
  expect(mesh.material.color.getHex()).toBe(0xffffff);
  fault.value = 'unplugged';
  sheet.update(0.4);
  expect(mesh.material.color.getHex()).toBe(0x555555);
});
