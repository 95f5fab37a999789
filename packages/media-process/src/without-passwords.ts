/** GStreamer's messages name addresses, and those may contain a password. */
export function withoutPasswords(text: string): string {
  return text.replaceAll(/(\w+:\/\/)[^/?#\s"]*@/g, '$1…@');
}
