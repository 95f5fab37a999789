import { expect, test } from 'vitest';
import { figuresLine } from './figures-line.ts';

test('what the robot does, how fast, and how old the view is', () => {
  const facts = [
    { name: 'Robot', value: 'Rover' },
    { name: 'State', value: 'Driving', tone: 'good' as const },
    { name: 'Speed', value: '0.50 m/s  0.10 rad/s' },
    { name: 'View age', value: '120 ms' },
  ];
  expect(figuresLine(facts)).toEqual({ text: 'Driving · 0.50 m/s · 120 ms', tone: 'neutral' });
});

test('how many figures call for a look, and how urgently', () => {
  const facts = [
    { name: 'State', value: 'Stationary' },
    { name: 'Speed', value: '0.00 m/s  0.00 rad/s' },
    { name: 'Battery', value: '8 %', tone: 'bad' as const },
    { name: 'Loss', value: '7.0 %', tone: 'warning' as const },
  ];
  expect(figuresLine(facts)).toEqual({ text: 'Stationary · 0.00 m/s · – · ⚠ 2', tone: 'bad' });
});

test('who did it takes no room', () => {
  const facts = [{ name: 'State', value: 'Emergency stop (by Ada; released at the robot only)' }];
  expect(figuresLine(facts).text).toBe('Emergency stop · – · –');
});

test('no figure is invented', () => {
  expect(figuresLine([])).toEqual({ text: 'Figures · – · –', tone: 'neutral' });
  const silent = [
    { name: 'State', value: '–' },
    { name: 'Speed', value: '–' },
  ];
  expect(figuresLine(silent).text).toBe('– · – · –');
});
