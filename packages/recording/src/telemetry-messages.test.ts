import type { DiagnosticReport } from '@farpoint/protocol';
import { DiagnosticBoard } from '@farpoint/ros';
import { parse } from '@foxglove/rosmsg';
import { MessageReader } from '@foxglove/rosmsg2-serialization';
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { ALARM_SCHEMA, DIAGNOSTIC_ARRAY_SCHEMA, FOXGLOVE_COMPRESSED_VIDEO_SCHEMA } from './ros-schemas.ts';
import { compressedVideo } from './ros-writer.ts';
import { alarmMessage, diagnosticArray } from './telemetry-messages.ts';

const read = (schema: string, bytes: Uint8Array): unknown =>
  new MessageReader(parse(schema, { ros2: true })).readMessage(bytes);
const texts = fc.string({ unit: 'grapheme', maxLength: 40 });

it('writes every text whole, whatever its characters', () => {
  fc.assert(
    fc.property(texts, texts, (text, unit) => {
      const alarm = { level: 'warn', text, unit, value: 1, limit: 2 } as const;
      expect(read(ALARM_SCHEMA, alarmMessage(1n, alarm))).toMatchObject(alarm);
      const report: DiagnosticReport = { name: text, level: 'stale', message: unit, sinceMs: 1500 };
      const array = read(
        DIAGNOSTIC_ARRAY_SCHEMA,
        diagnosticArray(1n, [report, report], () => 0n),
      );
      const board = new DiagnosticBoard();
      board.take(array, 1500);
      expect(board.components).toEqual([report]);
      const video = compressedVideo(1n, text, 'h264', Uint8Array.of(1, 2));
      expect(read(FOXGLOVE_COMPRESSED_VIDEO_SCHEMA, video)).toMatchObject({ frame_id: text, format: 'h264' });
    }),
  );
});
