import { signal } from '@preact/signals-core';
import type { CanvasTexture } from 'three';
import { expect, test } from 'vitest';
import type { CameraView } from '../pictures/camera-view.ts';
import { PANEL_ORDER } from './panel-order.ts';
import { PictureSheet } from './picture-sheet.ts';

test('a picture is uploaded once, and an old or faulty one is grey', () => {
  const newest = signal<{ number: number } | null>(null);
  const [stale, fault] = [signal(false), signal<string | null>(null)];
  const canvas = { width: 640, height: 480 };
  const sheet = new PictureSheet(
    { canvas, newest, stale, fault } as unknown as CameraView,
    PANEL_ORDER.wrist,
  );
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

test('no point of a cloud covers a picture, and a picture in front does not cover the wrist', () => {
  const newest = signal<{ number: number } | null>({ number: 1 });
  const [stale, fault] = [signal(false), signal<string | null>(null)];
  const canvas = { width: 640, height: 480 };
  const view = { canvas, newest, stale, fault } as unknown as CameraView;
  const front = new PictureSheet(view, PANEL_ORDER.frontPicture).mesh;
  const wrist = new PictureSheet(view, PANEL_ORDER.wristPicture).mesh;
  for (const { material } of [front, wrist]) {
    expect(material.depthTest).toBe(false);
    // Otherwise it would be drawn among what is opaque: before the points.
    expect(material.transparent).toBe(true);
  }
  expect(front.renderOrder).toBeLessThan(wrist.renderOrder);
  // The highest of what the world draws: a goal's marker.
  expect(front.renderOrder).toBeGreaterThan(10);
});
