/** How urgent a text is: its colour. */
export type Tone = 'good' | 'neutral' | 'warning' | 'bad';

export interface Words {
  text: string;
  tone: Tone;
}
