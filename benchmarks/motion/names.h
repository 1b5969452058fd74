/* Names and files by the prefix of the emitted code, which is NAME. */
#define JOINED_(a, b) a##_##b
#define JOINED(a, b) JOINED_(a, b)
#define OWN(name) JOINED(NAME, name)
#define TEXT_(a) #a
#define TEXT(a) TEXT_(a)
