// Prints the size of X3D documents (XML) in X3D's compressed binary encoding (ISO/IEC 19776-3), a line each with two
// numbers: with the encodings of Fast Infoset itself for floats and integers (four bytes a number), and with X3D's
// own, which deflate them. Debian's libfastinfoset-java writes the documents, and reads them again: every number must
// have kept all its bits.
//
// X3D's table of names of elements and fields, which a real file refers to, is not used: each name is in the file
// once, which takes some two hundred bytes.
//
//   java -cp /usr/share/java/FastInfoset.jar bench/X3dbSizes.java FILE.x3d...

import com.sun.xml.fastinfoset.sax.SAXDocumentParser;
import com.sun.xml.fastinfoset.sax.SAXDocumentSerializer;
import com.sun.xml.fastinfoset.vocab.ParserVocabulary;
import com.sun.xml.fastinfoset.vocab.SerializerVocabulary;
import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.File;
import java.nio.ByteBuffer;
import java.nio.FloatBuffer;
import java.nio.IntBuffer;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.StringTokenizer;
import java.util.zip.DataFormatException;
import java.util.zip.Deflater;
import java.util.zip.Inflater;
import javax.xml.parsers.SAXParserFactory;
import org.jvnet.fastinfoset.EncodingAlgorithmIndexes;
import org.jvnet.fastinfoset.sax.EncodingAlgorithmAttributes;
import org.jvnet.fastinfoset.sax.helpers.EncodingAlgorithmAttributesImpl;
import org.jvnet.fastinfoset.sax.helpers.FastInfosetDefaultHandler;
import org.xml.sax.Attributes;
import org.xml.sax.SAXException;
import org.xml.sax.helpers.DefaultHandler;

public final class X3dbSizes {
  private static final String FLOATS = "encoder://web3d.org/QuantizedzlibFloatArrayEncoder";
  private static final String INTEGERS = "encoder://web3d.org/DeltazlibIntArrayEncoder";
  /** The vocabulary that documents refer to: the two encodings. */
  private static final String VOCABULARY = "urn:external-vocabulary";
  /** The fields of geometry that are lists of numbers, and whether the numbers are floats. */
  private static final Map<String, Boolean> LISTS =
      Map.of("point", true, "vector", true, "index", false, "stripCount", false);

  /** Bytes of 5.4.3: with 8 bits of exponent and 23 of mantissa the packed numbers are floats, highest byte first. */
  private static byte[] deflated(float[] numbers) {
    ByteBuffer plain = ByteBuffer.allocate(4 * numbers.length);
    plain.asFloatBuffer().put(numbers);
    ByteBuffer header = ByteBuffer.allocate(10);
    header.put((byte) 8).put((byte) 23).putInt(plain.capacity()).putInt(numbers.length);
    return deflated(header.array(), plain.array());
  }

  /** Bytes of 5.5.2: each integer after the first `span` is the difference to the one `span` before it, plus 1. */
  private static byte[] deflated(int[] numbers, int span) {
    ByteBuffer plain = ByteBuffer.allocate(4 * numbers.length);
    for (int i = 0; i < numbers.length; ++i)
      plain.putInt(numbers[i] - (i >= span ? numbers[i - span] : 0) + 1);
    return deflated(ByteBuffer.allocate(5).putInt(numbers.length).put((byte) span).array(), plain.array());
  }

  private static byte[] deflated(byte[] header, byte[] plain) {
    Deflater deflater = new Deflater(Deflater.BEST_COMPRESSION);
    deflater.setInput(plain);
    deflater.finish();
    ByteArrayOutputStream bytes = new ByteArrayOutputStream();
    bytes.writeBytes(header);
    byte[] buffer = new byte[1 << 16];
    while (!deflater.finished())
      bytes.write(buffer, 0, deflater.deflate(buffer));
    deflater.end();
    return bytes.toByteArray();
  }

  private static ByteBuffer inflated(byte[] bytes, int headerLength, int length) throws DataFormatException {
    Inflater inflater = new Inflater();
    inflater.setInput(bytes, headerLength, bytes.length - headerLength);
    byte[] plain = new byte[length];
    for (int at = 0; at < length && !inflater.finished();)
      at += inflater.inflate(plain, at, length - at);
    inflater.end();
    return ByteBuffer.wrap(plain);
  }

  /** What deflated() has written. */
  private static Object inflated(byte[] bytes, boolean isFloats) throws DataFormatException {
    ByteBuffer header = ByteBuffer.wrap(bytes);
    if (isFloats) {
      float[] numbers = new float[header.getInt(6)];
      inflated(bytes, 10, header.getInt(2)).asFloatBuffer().get(numbers);
      return numbers;
    }
    int[] numbers = new int[header.getInt(0)];
    inflated(bytes, 5, 4 * numbers.length).asIntBuffer().get(numbers);
    for (int i = 0; i < numbers.length; ++i)
      numbers[i] += (i >= bytes[4] ? numbers[i - bytes[4]] : 0) - 1;
    return numbers;
  }

  private static float[] floats(String list) {
    FloatBuffer numbers = FloatBuffer.allocate(list.length() / 2 + 1);
    for (StringTokenizer words = new StringTokenizer(list); words.hasMoreTokens();)
      numbers.put(Float.parseFloat(words.nextToken()));
    return Arrays.copyOf(numbers.array(), numbers.position());
  }

  private static int[] integers(String list) {
    IntBuffer numbers = IntBuffer.allocate(list.length() / 2 + 1);
    for (StringTokenizer words = new StringTokenizer(list); words.hasMoreTokens();)
      numbers.put(Integer.parseInt(words.nextToken()));
    return Arrays.copyOf(numbers.array(), numbers.position());
  }

  /** Of both spans the smaller result: lists of indices come in threes, or follow one another in strips. */
  private static byte[] smallest(int[] numbers) {
    byte[] one = deflated(numbers, 1), three = deflated(numbers, 3);
    return one.length <= three.length ? one : three;
  }

  /** A document that is written in one of the two ways. */
  private static final class Writer {
    private final ByteArrayOutputStream bytes = new ByteArrayOutputStream();
    private final SAXDocumentSerializer serializer = new SAXDocumentSerializer();
    private final List<Object> lists = new ArrayList<>();
    private final boolean isDeflated;

    Writer(boolean isDeflated) throws SAXException {
      this.isDeflated = isDeflated;
      SerializerVocabulary vocabulary = new SerializerVocabulary(), named = new SerializerVocabulary();
      named.encodingAlgorithm.add(FLOATS);
      named.encodingAlgorithm.add(INTEGERS);
      vocabulary.setExternalVocabulary(VOCABULARY, named, false);
      serializer.setVocabulary(vocabulary);
      serializer.setOutputStream(bytes);
      serializer.startDocument();
    }

    void start(String name, Attributes attributes) throws SAXException {
      EncodingAlgorithmAttributesImpl coded = new EncodingAlgorithmAttributesImpl();
      for (int i = 0; i < attributes.getLength(); ++i)
        add(coded, attributes.getQName(i), attributes.getValue(i));
      serializer.startElement("", name, name, coded);
    }

    private void add(EncodingAlgorithmAttributesImpl coded, String field, String value) {
      Boolean isFloats = LISTS.get(field);
      if (isFloats == null) {
        coded.addAttribute("", field, field, "CDATA", value);
        return;
      }
      Object numbers = isFloats ? floats(value) : integers(value);
      lists.add(numbers);
      if (isDeflated)
        coded.addAttributeWithAlgorithmData("", field, field, isFloats ? FLOATS : INTEGERS, 0,
            isFloats ? deflated((float[]) numbers) : smallest((int[]) numbers));
      else
        coded.addAttributeWithBuiltInAlgorithmData("", field, field,
            isFloats ? EncodingAlgorithmIndexes.FLOAT : EncodingAlgorithmIndexes.INT, numbers);
    }

    void end(String name) throws SAXException {
      serializer.endElement("", name, name);
    }

    /** Size of the document, which has been read again. */
    int size() throws Exception {
      serializer.endDocument();
      Reader reader = new Reader(lists);
      ParserVocabulary named = new ParserVocabulary();
      named.encodingAlgorithm.add(FLOATS);
      named.encodingAlgorithm.add(INTEGERS);
      SAXDocumentParser parser = new SAXDocumentParser();
      parser.setExternalVocabularies(Map.of(VOCABULARY, named));
      parser.setContentHandler(reader);
      parser.setEncodingAlgorithmContentHandler(reader); // without it the parser refuses X3D's encodings
      parser.parse(new ByteArrayInputStream(bytes.toByteArray()));
      if (reader.count != lists.size())
        throw new SAXException("the document has other lists of numbers than were written");
      return bytes.size();
    }
  }

  /** Compares the lists of numbers of a document with those that were written. */
  private static final class Reader extends FastInfosetDefaultHandler {
    private final List<Object> written;
    int count = 0;

    Reader(List<Object> written) {
      this.written = written;
    }

    @Override
    public void startElement(String uri, String localName, String name, Attributes attributes) throws SAXException {
      EncodingAlgorithmAttributes coded = (EncodingAlgorithmAttributes) attributes;
      for (int i = 0; i < coded.getLength(); ++i) {
        Boolean isFloats = LISTS.get(coded.getQName(i));
        if (isFloats == null)
          continue;
        Object data = coded.getAlgorithmData(i);
        try {
          if (data instanceof byte[])
            data = inflated((byte[]) data, isFloats);
        } catch (DataFormatException error) {
          throw new SAXException(error);
        }
        if (!Arrays.deepEquals(new Object[] {data}, new Object[] {written.get(count++)}))
          throw new SAXException("a list of numbers reads back as another one");
      }
    }
  }

  public static void main(String[] files) throws Exception {
    for (String file : files) {
      Writer[] writers = {new Writer(false), new Writer(true)};
      SAXParserFactory.newInstance().newSAXParser().parse(new File(file), new DefaultHandler() {
        @Override
        public void startElement(String uri, String localName, String name, Attributes attributes) throws SAXException {
          for (Writer writer : writers)
            writer.start(name, attributes);
        }

        @Override
        public void endElement(String uri, String localName, String name) throws SAXException {
          for (Writer writer : writers)
            writer.end(name);
        }
      });
      System.out.println(writers[0].size() + " " + writers[1].size());
    }
  }
}
