import { readFileSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { beforeEach, expect, it } from 'vitest';
import { ReleaseRequest } from './release-request.ts';

let folder: string;
beforeEach(() => {
  folder = testFolder();
});

it('is taken once, however often it was made', () => {
  const request = new ReleaseRequest(folder, 'robot-1');
  expect(request.take()).toBe(false);
  request.make();
  request.make();
  expect([request.take(), request.take()]).toEqual([true, false]);
});

it('that root makes touches no file to which the robot’s user has put a link', () => {
  const precious = join(folder, 'precious');
  writeFileSync(precious, 'kept');
  symlinkSync(precious, join(folder, 'robot-1.release'));
  const request = new ReleaseRequest(folder, 'robot-1');
  request.make();
  expect([readFileSync(precious, 'utf8'), request.take()]).toEqual(['kept', true]);
  expect(readFileSync(precious, 'utf8')).toBe('kept');
});
